#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

/// Which process gets which cell. The result of a refinement does not depend on it; how much must
/// be told between processes does.
namespace octetra::distributed {

enum class PartitionMethod {
    rcb,     ///< recursive coordinate bisection of the cells' centroids
    lepp,    ///< METIS on the graph that joins cells through their longest edges (the paper's)
    dual,    ///< METIS on the graph that joins cells through faces
    block,   ///< equal shares in the order of the input
    random,  ///< at random
    file,    ///< as a file says
};

struct Partition {
    PartitionMethod method = PartitionMethod::rcb;
    std::uint64_t seed = 0;      ///< for random
    std::filesystem::path path;  ///< for file: part numbers from 0, one for each cell, in order
};

/// Does it make parts even in weights?
[[nodiscard]] inline bool takes_weights(const Partition& partition) {
    return partition.method == PartitionMethod::lepp || partition.method == PartitionMethod::dual ||
           partition.method == PartitionMethod::rcb;
}

/// "rcb", "lepp", "dual", "block", "random:SEED" or "file:PATH". Throws InputError.
[[nodiscard]] Partition parse_partition(const std::string& text);
/// The other way.
[[nodiscard]] std::string text_of(const Partition& partition);

/// The part, 0 to parts-1, of each cell; parts may be empty. By lepp, dual and rcb, parts are
/// about equal in the sum of their cells' weights, such as predicted_cells() finds, as far as no
/// single cell outweighs a part; without weights, in their number. Not collective: one process
/// decides. Throws InputError where a part file does not fit the mesh, METIS cannot count so many
/// cells, or there are weights but not one for each cell, positive and finite; SystemError where
/// METIS fails. METIS takes a SIGTERM that comes while it works for a failure: it ends in the
/// SystemError, and no other handler gets it.
[[nodiscard]] std::vector<int> partition_cells(const Mesh& mesh, int parts,
                                               const Partition& partition,
                                               const std::vector<float>& weights = {});

/// How good a partition is. Less cut, fewer shared vertices and an even balance are better.
struct PartitionStatistics {
    std::vector<std::uint64_t> cells_of_part;
    std::vector<std::uint64_t> shared_vertices_of_part;  ///< that some other part has as well
    std::vector<std::uint64_t> neighbours_of_part;       ///< parts with which it shares a vertex
    std::uint64_t inner_faces = 0;
    std::uint64_t cut_faces = 0;  ///< between cells of different parts
    /// Pairs of cells of which one has its longest edge in the other: the steps that selections
    /// take.
    std::uint64_t longest_edge_links = 0;
    std::uint64_t cut_longest_edge_links = 0;
};

[[nodiscard]] PartitionStatistics measure_partition(const Mesh& mesh,
                                                    const std::vector<int>& cell_to_part,
                                                    int parts);

}  // namespace octetra::distributed
