#pragma once

#include <functional>
#include <vector>

#include "properties/case.hpp"

namespace octetra::properties {

/// The cases that are simpler by one change, the largest change first: without some cells, steps,
/// levels, criteria, ranks, marks; with the default scheme and synchronisation; with coordinates of
/// fewer digits. Simplification has no cycles, so repeated application ends. The functions may
/// outlive `c`.
[[nodiscard]] std::vector<std::function<Case()>> simplifications(const Case& c);

enum class Trial { fails, holds, not_made };

/// Repeatedly follows a simplification that fails, until none does or a trial is not made. Returns
/// the last case that failed, or `c` if none did.
[[nodiscard]] Case simplest(Case c, const std::function<Trial(const Case&)>& attempt);

}  // namespace octetra::properties
