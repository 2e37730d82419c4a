#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// What other cells can notice of the order of a cell's edges by length. A cell tells the others
/// nothing but which of its edges are marked, and they hear of those only that are theirs, too.
namespace octetra::properties {

/// The six edges of a cell (0 to 5, as in cell_edges), longest first.
using Order = std::array<std::size_t, 6>;

inline constexpr std::size_t order_count = 720;

/// Its number among all orders, 0 to 719: they ascend lexicographically.
[[nodiscard]] std::size_t number_of(const Order& order);

/// A set of a cell's edges: bit e for edge e.
using EdgeBits = unsigned;

/// The least set with these edges in which every face that has an edge has its longest one.
[[nodiscard]] EdgeBits closed_in_cell(const Order& order, EdgeBits marked);

/// Orders are of one class if they put the shared edges in the same order and if, marked by any
/// scheme or not at all, and whichever shared edges are marked from outside, the same shared
/// edges are marked in the end.
struct OrderClass {
    std::vector<std::size_t> shared;  ///< the shared edges, longest first
    std::size_t size = 0;             ///< how many orders are of this class
};

struct OrderClasses {
    std::vector<OrderClass> classes;
    std::vector<std::size_t> class_of;  ///< for each of the 720 orders by number, its class
};

/// The classes of the orders of a cell that has these edges in common with other cells.
[[nodiscard]] OrderClasses classes_of_orders(EdgeBits shared);

}  // namespace octetra::properties
