#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// An undirected weighted graph of the cells: the neighbours of cell c are
/// neighbours[begin[c]] .. neighbours[begin[c+1] - 1], ascending.
struct CellGraph {
    std::vector<std::int32_t> begin;
    std::vector<std::int32_t> neighbours;
    std::vector<std::int32_t> weights;
};

/// Cells that share a face, with weight 1.
[[nodiscard]] CellGraph face_dual_graph(const Mesh& mesh);

/// Each cell joined to every other one at its longest edge, with weight 1, or 2 where both have
/// that edge as their longest: the first steps of the longest-edge propagation paths.
[[nodiscard]] CellGraph longest_edge_graph(const Mesh& mesh);

/// The face-dual graph, and each cell joined to every other one at its longest edge, with a greater
/// weight: a selection propagates from a cell to those. So that a cut seldom crosses a propagation
/// path.
[[nodiscard]] CellGraph lepp_graph(const Mesh& mesh);

}  // namespace octetra::distributed
