#pragma once

#include <functional>
#include <vector>

#include "properties/case.hpp"

namespace octetra::properties {

/// Ways to make a case simpler by one thing, the boldest first: without some cells, levels,
/// criteria, ranks, marks; with the default scheme and synchronisation; with rounder coordinates.
/// None leads back, so trying them over and over ends. Each may be called once the case is gone.
[[nodiscard]] std::vector<std::function<Case()>> simplifications(const Case& c);

}  // namespace octetra::properties
