#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

/// Reads a mesh file with several processes, none of which has the whole mesh in memory.
namespace octetra {

/// The share of a mesh that one process has read: of each list one block, in the order of ranks.
struct MeshShare {
    MeshFacts facts;  ///< of the whole mesh
    /// The entities of this process's blocks, with global vertex numbers. Markers that `facts` does
    /// not have are empty on all processes. Features are as read: numbers in range in any order;
    /// `facts` counts repeated ones repeatedly.
    Mesh lists;
    std::uint64_t first_vertex = 0;
    std::uint64_t first_cell = 0;
    std::uint64_t first_facet = 0;
    std::uint64_t first_edge = 0;
    /// Messages for ReadOptions::note; equal on all processes.
    std::vector<std::string> notes;
};

/// Collective; not to be called within a transaction. Reads a mesh; every process reads an even
/// share of the bytes of each file. Performs the checks of read_mesh() that need only a line or row
/// and the counts: syntax, counts, number ranges, and that the vertices of an entity are distinct.
/// The caller performs the others: orientation, repeated cells, tagged facets and edges.
///
/// Returns nothing on all processes if a check fails, a file cannot be read, or its format is not
/// suitable; text formats require one entity on each line. read_mesh() then reports the error.
///
/// Throws std::bad_alloc on all processes if one of them is out of memory.
[[nodiscard]] std::optional<MeshShare> read_mesh_share(const std::filesystem::path& path,
                                                       const ProcessGroup& group);

}  // namespace octetra
