#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// Equivalence of orders of a cell's edges by length, as seen by other cells. Cells influence each
/// other only by the marks of shared edges.
namespace octetra::properties {

/// The six edges of a cell (0 to 5, as in cell_edges), longest first.
using Order = std::array<std::size_t, 6>;

inline constexpr std::size_t order_count = 720;

/// The number of the order among all orders in lexicographic sequence, 0 to 719.
[[nodiscard]] std::size_t number_of(const Order& order);

/// A set of a cell's edges: bit e for edge e.
using EdgeBits = unsigned;

/// The least superset of these edges in which every face that has an edge has its longest edge.
[[nodiscard]] EdgeBits closed_in_cell(const Order& order, EdgeBits marked);

/// Orders are in one class if they sort the shared edges in the same way and if, for every scheme
/// or none, and for every set of shared edges marked from outside, the same shared edges are marked
/// after closure.
struct OrderClass {
    std::vector<std::size_t> shared;  ///< the shared edges, longest first
    std::size_t size = 0;             ///< the number of orders in this class
};

struct OrderClasses {
    std::vector<OrderClass> classes;
    std::vector<std::size_t> class_of;  ///< for each of the 720 orders by number, its class
};

/// The classes of the orders of a cell that shares these edges with other cells.
[[nodiscard]] OrderClasses classes_of_orders(EdgeBits shared);

}  // namespace octetra::properties
