#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "partition/cell_weights.hpp"

namespace octetra::distributed {

/// An undirected weighted graph of cells, or of groups of cells, as METIS wants it: the neighbours
/// of node n are neighbours[begin[n]] .. neighbours[begin[n+1] - 1], each once.
struct CellGraph {
    std::vector<std::int32_t> begin;
    std::vector<std::int32_t> neighbours;
    std::vector<std::int32_t> weights;  ///< of the links
    std::vector<std::int32_t> node_weights;
    std::vector<std::int32_t> cell_to_node;
};

/// Throws InputError where a graph of so many cells might not fit METIS, which counts in 32 bits.
void check_graph_size(std::uint64_t cells);

/// Each cell a node; joined, with weight 1, are those that share a face. Throws InputError where
/// there are too many cells.
[[nodiscard]] CellGraph face_dual_graph(const Mesh& mesh, const CellWeights& weights);

/// Cells with the same longest edge in one node, unless they weigh more than `most`, and lone ones
/// with a neighbour (cell_groups.hpp). Nodes are joined through the faces between their cells. A
/// face weighs more if its cells have their longest edge in it, because then selections go through
/// it. Throws InputError where there are too many cells.
[[nodiscard]] CellGraph lepp_graph(const Mesh& mesh, const CellWeights& weights, std::int64_t most);

}  // namespace octetra::distributed
