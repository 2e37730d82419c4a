#pragma once

#include <vector>

#include "properties/case.hpp"

namespace octetra::properties {

/// The histories that are simpler by one change, the largest change first: without some steps,
/// without a criterion or some cell numbers in it, with the default scheme, loaded on one rank,
/// through Medit text. Simplification has no cycles.
[[nodiscard]] std::vector<std::vector<Step>> simpler_steps(const std::vector<Step>& steps);

}  // namespace octetra::properties
