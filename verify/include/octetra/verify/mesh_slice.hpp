#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra::verify {

/// The numbers of entities of a whole mesh.
struct Totals {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< tagged ones
};

/// The part of a distributed mesh that one process holds: a contiguous slice of each list, in the
/// order of ranks. Of `count` entities, process r of n holds those from slice_begin(count, r, n)
/// on.
struct MeshSlice {
    Mesh lists;  ///< the slices; vertices have global numbers
    Totals totals;
};

/// Returns the window of all `count` entities of a kind, in slices of equal length for `size`
/// processes; the last slices are shorter or empty.
[[nodiscard]] constexpr Window slices_of(std::uint64_t count, int size) {
    const auto n = static_cast<std::uint64_t>(size);
    return {0, (count + n - 1) / n, count};
}
[[nodiscard]] inline std::uint64_t slice_begin(std::uint64_t count, int rank, int size) {
    return slices_of(count, size).begin_of(rank);
}

/// Collective. Distributes the slices of a mesh held by the first process, which must satisfy the
/// first invariant of struct Mesh except that indices may be out of range. The arguments of other
/// processes are ignored.
[[nodiscard]] MeshSlice distribute_slices(const Mesh& mesh, const ProcessGroup& group);

/// Collective. Returns the slices of a mesh file, which the first process reads and distributes
/// without holding all of it. Only the option `note` is used, as by stream_mesh(). Throws the
/// errors of stream_mesh() on all processes.
[[nodiscard]] MeshSlice read_slice(const std::filesystem::path& path, const ReadOptions& options,
                                   const ProcessGroup& group);

/// Collective in the mesh's group, whose processes must be those of the verifier's group. Returns
/// the slices of a distributed mesh.
[[nodiscard]] MeshSlice slice_of(MeshSource& mesh);

}  // namespace octetra::verify
