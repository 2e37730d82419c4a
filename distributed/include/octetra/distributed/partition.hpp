#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

/// Partitions of cells among processes. The result of refinement does not depend on the partition;
/// the amount of communication does.
namespace octetra::distributed {

enum class PartitionMethod {
    rcb,     ///< recursive coordinate bisection of the cells' centroids
    lepp,    ///< METIS on the graph that joins cells through their longest edges (the paper's)
    dual,    ///< METIS on the graph that joins cells through faces
    block,   ///< equal contiguous blocks in the order of the input
    random,  ///< at random
    file,    ///< read from a file
};

struct Partition {
    PartitionMethod method = PartitionMethod::rcb;
    std::uint64_t seed = 0;      ///< for random
    std::filesystem::path path;  ///< for file: part numbers from 0, one for each cell, in order
};

/// Returns whether the method balances weights of cells.
[[nodiscard]] inline bool takes_weights(const Partition& partition) {
    return partition.method == PartitionMethod::lepp || partition.method == PartitionMethod::dual ||
           partition.method == PartitionMethod::rcb;
}

/// Parses "rcb", "lepp", "dual", "block", "random:SEED" or "file:PATH". Throws InputError.
[[nodiscard]] Partition parse_partition(const std::string& text);
/// The inverse of parse_partition().
[[nodiscard]] std::string text_of(const Partition& partition);

/// Returns the part, 0 to parts-1, of each cell; parts may be empty. With the methods lepp, dual
/// and rcb, the parts have about equal sums of weights, such as those of predicted_cells(), unless
/// a single cell outweighs a part; without weights, about equal numbers of cells. Not collective:
/// one process computes the partition. Throws InputError if a part file does not fit the mesh,
/// METIS cannot represent the number of cells, or there are weights but not one for each cell,
/// positive and finite; SystemError if METIS fails. METIS intercepts SIGTERM and treats it as a
/// failure: a SIGTERM during its work results in the SystemError, and no other handler is called.
[[nodiscard]] std::vector<int> partition_cells(const Mesh& mesh, int parts,
                                               const Partition& partition,
                                               const std::vector<float>& weights = {});

/// Quality of a partition. Lower cut, fewer shared vertices and better balance reduce cost.
struct PartitionStatistics {
    std::vector<std::uint64_t> cells_of_part;
    std::vector<std::uint64_t> shared_vertices_of_part;  ///< vertices that another part has as well
    std::vector<std::uint64_t> neighbours_of_part;       ///< parts with which it shares a vertex
    std::uint64_t inner_faces = 0;
    std::uint64_t cut_faces = 0;  ///< inner faces between cells of different parts
    /// Pairs of cells such that the longest edge of one is an edge of the other: the links along
    /// which marks propagate.
    std::uint64_t longest_edge_links = 0;
    std::uint64_t cut_longest_edge_links = 0;
};

/// Measures a partition of a mesh; `cell_to_part` has the part, 0 to parts-1, of each cell. Not
/// collective.
[[nodiscard]] PartitionStatistics measure_partition(const Mesh& mesh,
                                                    const std::vector<int>& cell_to_part,
                                                    int parts);

}  // namespace octetra::distributed
