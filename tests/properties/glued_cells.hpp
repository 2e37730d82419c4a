#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "properties/order_classes.hpp"
#include "properties/small_complexes.hpp"

/// The worlds of a complex, one for each way to order the edges of its cells by length. Nothing but
/// comparisons within cells matters to refinement: of two orders that agree on these there is one
/// world. Corners are named so that no two worlds are the same but for that.
namespace octetra::properties {

/// Cells that have orders out of one list, whichever for each of them, and are so similar that
/// it does not matter which cell has which.
struct AlikeCells {
    std::vector<Order> orders;
    std::size_t count = 1;
};

/// What `glued` takes: cells, and for one after the other what orders they have.
struct WorldKind {
    std::string name;
    Complex complex;
    std::vector<AlikeCells> cells;
};

[[nodiscard]] std::size_t count_worlds(const WorldKind& kind);

/// The world that has this number, from 0.
[[nodiscard]] Mesh world_of(const WorldKind& kind, std::size_t number);

/// In each of the 720 orders.
[[nodiscard]] const WorldKind& one_cell();

/// For each of the 120 orders of a cell in which the edges of one face descend, 120 of the other.
/// Each pair is there both ways round.
[[nodiscard]] const WorldKind& two_cells_at_a_face();

/// For each of 180 orders of the first cell, 360 of the other. (720 by four, as exchanging the ends
/// of the common edge, or the two other corners, only names corners otherwise; and by two.) Each
/// pair is there both ways round.
[[nodiscard]] const WorldKind& two_cells_at_an_edge();

/// The first has a face in common with either of the others. For each of 180 orders of the cell in
/// the middle, 120 of either cell beside it. (720 by four: exchanging its two faces, or the ends of
/// the edge between them, only names corners otherwise.)
[[nodiscard]] const WorldKind& three_cells_in_a_row();

/// Cells that meet at one vertex, at one edge, or not at all; or two at one vertex, edge or face
/// and one apart. Also up to exchanging cells. Those with an edge are two kinds, one after the
/// other.
[[nodiscard]] const std::vector<WorldKind>& kinds_up_to_exchange();

}  // namespace octetra::properties
