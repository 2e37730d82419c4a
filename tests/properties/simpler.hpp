#pragma once

#include <functional>
#include <vector>

#include "properties/case.hpp"

namespace octetra::properties {

/// Ways to make a case simpler by one thing, the boldest first: without some cells, steps,
/// levels, criteria, ranks, marks; with the default scheme and synchronisation; with rounder
/// coordinates. None leads back, so trying them over and over ends. Each may be called once the
/// case is gone.
[[nodiscard]] std::vector<std::function<Case()>> simplifications(const Case& c);

enum class Trial { fails, holds, not_made };

/// Follows the simplifications that fail until none does, or a trial is not made: then it ends
/// there. The last case that failed; `c`, if none did.
[[nodiscard]] Case simplest(Case c, const std::function<Trial(const Case&)>& attempt);

}  // namespace octetra::properties
