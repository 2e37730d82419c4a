#pragma once

#include <array>
#include <cstddef>

#include "properties/small_complexes.hpp"

/// Combinations of orders of the cells of a complex and of the classes of these orders
/// (order_classes.hpp).
namespace octetra::properties {

/// Counts of three kinds: an order of one cell; a class of each cell; an order of one cell with a
/// class of each other cell.
using CombinationCounts = std::array<std::size_t, 3>;

/// Counts the combinations that comparisons alone permit: two cells compare the edges of a common
/// face in the same way, and comparisons have no cycle. Some may have no geometric realisation.
[[nodiscard]] CombinationCounts count_combinations(const Complex& complex);

}  // namespace octetra::properties
