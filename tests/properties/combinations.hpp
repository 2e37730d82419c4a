#pragma once

#include <array>
#include <cstddef>

#include "properties/small_complexes.hpp"

/// Combinations of what the cells of a complex are like: of their orders, and of the classes of
/// these (order_classes.hpp).
namespace octetra::properties {

/// Of an order of one cell; of a class of each cell; of an order of one cell and a class of each
/// other.
using CombinationCounts = std::array<std::size_t, 3>;

/// How many there are by comparisons alone: two cells compare the edges of a common face the same
/// way, and no edges are longer than one another in a circle. Not all need have a geometry.
[[nodiscard]] CombinationCounts count_combinations(const Complex& complex);

}  // namespace octetra::properties
