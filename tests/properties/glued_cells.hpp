#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"
#include "properties/small_complexes.hpp"

/// The worlds of a complex, one for each way to order the edges of its cells by length. Refinement
/// depends only on comparisons within cells: orders that agree on these have one world. Corners are
/// named so that no two worlds differ only by names.
namespace octetra::properties {

/// Cells that take their orders from one list and are interchangeable: it does not matter which
/// cell has which order.
struct InterchangeableCells {
    std::vector<Order> orders;
    std::size_t count = 1;
};

/// The arguments of glued(): cells, and the orders that each may have.
struct WorldKind {
    std::string name;
    Complex complex;
    std::vector<InterchangeableCells> cells;
};

[[nodiscard]] std::size_t count_worlds(const WorldKind& kind);

/// The world with this number, from 0.
[[nodiscard]] Mesh world_of(const WorldKind& kind, std::size_t number);

/// One cell, in each of the 720 orders.
[[nodiscard]] const WorldKind& one_cell();

/// For each of the 120 orders of a cell in which the edges of one face descend, 120 orders of the
/// other cell. Both arrangements of each pair occur.
[[nodiscard]] const WorldKind& two_cells_at_a_face();

/// For each of 180 orders of the first cell, 360 of the other. (720 / 4, because exchanging the
/// ends of the common edge, or the two other corners, only renames corners; and 720 / 2.) Both
/// arrangements of each pair occur.
[[nodiscard]] const WorldKind& two_cells_at_an_edge();

/// The first cell has a face in common with each of the others. For each of 180 orders of the
/// middle cell, 120 of each cell beside it. (720 / 4: exchanging its two faces, or the ends of the
/// edge between them, only renames corners.)
[[nodiscard]] const WorldKind& three_cells_in_a_row();

/// Cells that meet at one vertex, at one edge, or not at all; or two at one vertex, edge or face
/// and one apart: all up to the exchange of cells. Complexes with a common edge have two
/// consecutive kinds.
[[nodiscard]] const std::vector<WorldKind>& kinds_up_to_exchange();

}  // namespace octetra::properties
