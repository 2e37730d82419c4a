#pragma once

#include <vector>

#include "properties/case.hpp"

namespace octetra::properties {

/// Ways to make a history simpler by one thing, the boldest first: without some steps, without a
/// criterion or some numbers of cells in one of them, with the default scheme, loaded on one rank,
/// through Medit text. None leads back.
[[nodiscard]] std::vector<std::vector<Step>> simpler_steps(const std::vector<Step>& steps);

}  // namespace octetra::properties
