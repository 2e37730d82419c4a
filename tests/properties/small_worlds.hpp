#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

/// The smallest meshes there are. Coordinates are whole numbers of at most 22 bits, so that worlds
/// can stand side by side in one mesh without changing a length. Those in which the order of edges
/// is exhausted are in glued_cells.hpp.
namespace octetra::properties {

/// The ways in which up to three cells can share vertices, up to symmetry: 1 of one cell, 4 of two,
/// 24 of three. (Three cells at one face are none: no mesh has them.) Each has the numbers of its
/// cells' vertices.
[[nodiscard]] std::vector<std::vector<std::array<std::size_t, 4>>> all_small_complexes();

/// A mesh of that complex with random corners: valid, and no two edges of a cell tie.
[[nodiscard]] Mesh some_geometry(const std::vector<std::array<std::size_t, 4>>& complex,
                                 std::uint64_t seed);

/// All worlds in one mesh, each so far along x from the one before, so that they do not meet.
[[nodiscard]] Mesh side_by_side(const std::vector<Mesh>& worlds, double distance);

/// The six edges of a cell (0 to 5, as in cell_edges), longest first.
[[nodiscard]] std::array<std::size_t, 6> order_of(const Mesh& mesh, CellIndex cell);

}  // namespace octetra::properties
