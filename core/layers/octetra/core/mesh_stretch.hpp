#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

/// A mesh file that processes read together, so that none has all of it in memory.
namespace octetra {

/// What one process has read: of each list a stretch, those of the first process first.
struct MeshStretch {
    MeshFacts facts;  ///< of the whole mesh
    /// The entities of the stretches; vertices go by their numbers in the whole mesh. Markers that
    /// facts says there are none of are left out on all processes. Of features a process has what
    /// it has read, as it stands: any numbers in range, and facts counts what comes twice twice.
    Mesh lists;
    std::uint64_t first_vertex = 0;
    std::uint64_t first_cell = 0;
    std::uint64_t first_facet = 0;
    std::uint64_t first_edge = 0;
    /// What read_mesh() would tell ReadOptions::note; the same on all processes.
    std::vector<std::string> notes;
};

/// Collective. Reads a mesh, of each file every process an even share of the bytes. What of
/// read_mesh()'s checks needs no more than a line or row and the counts is done: syntax, counts,
/// numbers in range, an entity's vertices different. The others are left to who calls: orientation,
/// cells that are there twice, tagged facets and edges.
///
/// Returns nothing, on all processes, where a check fails, a file cannot be read, or is not in the
/// form that lends itself to it, of text an entity on each line. What is to be said of the file
/// read_mesh() then says. A process that has no memory throws std::bad_alloc, and all others get
/// nothing: whoever calls must tell them.
[[nodiscard]] std::optional<MeshStretch> read_stretch(const std::filesystem::path& path,
                                                      const ProcessGroup& group);

}  // namespace octetra
