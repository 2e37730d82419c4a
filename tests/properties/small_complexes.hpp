#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "properties/order_classes.hpp"

/// Complexes of up to three cells, distinguished by the vertices that cells share.
namespace octetra::properties {

/// For each cell the numbers of its vertices, from 0 without gaps.
using Complex = std::vector<std::array<std::size_t, 4>>;

/// Two cells that share this number of vertices.
[[nodiscard]] Complex two_cells(std::size_t shared);

/// Three cells that share `all` vertices, where each pair shares the given number of further
/// vertices.
[[nodiscard]] Complex three_cells(std::size_t all, std::size_t ab, std::size_t ac, std::size_t bc);

/// All complexes up to symmetry: 1 of one cell, 4 of two, 24 of three. (Three cells at one face do
/// not occur in a mesh.)
[[nodiscard]] std::vector<Complex> all_small_complexes();

/// The numbers of two vertices, the smaller first.
using Edge = std::array<std::size_t, 2>;

/// The edge of a cell with this index in cell_edges.
[[nodiscard]] Edge edge_of(const std::array<std::size_t, 4>& cell, std::size_t e);

[[nodiscard]] std::size_t vertex_count(const Complex& complex);

/// The permutations of the vertices that preserve the complex: the i-th maps vertex v to
/// result[i][v].
[[nodiscard]] std::vector<std::vector<std::size_t>> symmetries(const Complex& complex);

/// For each cell the classes of orders of its edges.
[[nodiscard]] std::vector<OrderClasses> classes_of_cells(const Complex& complex);

}  // namespace octetra::properties
