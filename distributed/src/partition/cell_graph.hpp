#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "partition/cell_weights.hpp"

namespace octetra::distributed {

/// An undirected weighted graph of cells, or of groups of cells, in the format of METIS: the
/// neighbours of node n are neighbours[begin[n]] .. neighbours[begin[n+1] - 1], each once.
struct CellGraph {
    std::vector<std::int32_t> begin;
    std::vector<std::int32_t> neighbours;
    std::vector<std::int32_t> weights;  ///< of the links
    std::vector<std::int32_t> node_weights;
    std::vector<std::int32_t> cell_to_node;
};

/// Throws InputError if a graph of this many cells might exceed the 32-bit counters of METIS.
void check_graph_size(std::uint64_t cells);

/// Returns the graph whose nodes are cells, with links of weight 1 between cells that share a face.
/// Throws InputError if there are too many cells.
[[nodiscard]] CellGraph face_dual_graph(const Mesh& mesh, const CellWeights& weights);

/// Returns the graph whose nodes are groups of cells with the same longest edge, unless they weigh
/// more than `most`, joined with single neighbours (see cell_groups.hpp). Nodes are linked through
/// the faces between their cells. A face weighs more if its cells have their longest edge in it,
/// because marks propagate through it. Throws InputError if there are too many cells.
[[nodiscard]] CellGraph lepp_graph(const Mesh& mesh, const CellWeights& weights, std::int64_t most);

}  // namespace octetra::distributed
