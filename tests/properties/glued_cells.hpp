#pragma once

#include <array>
#include <cstddef>

#include <octetra/core/mesh.hpp>

/// Nearly regular cells, glued at faces and edges, whose edges have any order by length that is
/// asked for. Of an order nothing but comparisons within cells matters to refinement: of two orders
/// that agree on these there is one world. Corners are named so that no two worlds are the same but
/// for that. Coordinates are whole numbers of at most 22 bits.
namespace octetra::properties {

inline constexpr std::size_t one_cell_worlds = 720;

/// A cell in the order of its edges that has this number, from 0.
[[nodiscard]] Mesh one_cell_in_order(std::size_t number);

/// For each of the 120 orders of a cell in which the edges of one face descend, 120 of the other.
/// Each pair is there both ways round.
inline constexpr std::size_t two_cell_worlds = 120 * 120;

/// Two cells at a face.
[[nodiscard]] Mesh two_cells_in_order(std::size_t number);

/// For each of 180 orders of the first cell, 360 of the other. (720 by four, as exchanging the ends
/// of the common edge, or the two other corners, only names corners otherwise; and by two.) Each
/// pair is there both ways round.
inline constexpr std::size_t two_cell_worlds_at_an_edge = 180 * 360;

/// Two cells at an edge.
[[nodiscard]] Mesh two_cells_at_an_edge_in_order(std::size_t number);

/// For each of 180 orders of the cell in the middle, 120 of either cell beside it. (720 by four:
/// exchanging its two faces, or the ends of the edge between them, only names corners otherwise.)
inline constexpr std::size_t three_cell_worlds = 180 * 120 * 120;

/// Three cells in a row: the first has a face in common with either of the others.
[[nodiscard]] Mesh three_cells_in_order(std::size_t number);

}  // namespace octetra::properties
