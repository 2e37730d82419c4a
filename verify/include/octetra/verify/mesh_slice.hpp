#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra::verify {

/// How many entities a whole mesh has.
struct Totals {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< tagged ones
};

/// What one process has of a mesh that is in several memories: of each list a stretch, process
/// after process. Of `count` entities process r of n has those from slice_begin(count, r, n) on.
struct MeshSlice {
    Mesh lists;  ///< the stretches; vertices are numbered as in the whole mesh
    Totals totals;
};

/// All `count` entities of a kind, in slices of equal length for `size` processes; the last ones
/// are shorter, or empty.
[[nodiscard]] constexpr Window slices_of(std::uint64_t count, int size) {
    const auto n = static_cast<std::uint64_t>(size);
    return {0, (count + n - 1) / n, count};
}
[[nodiscard]] inline std::uint64_t slice_begin(std::uint64_t count, int rank, int size) {
    return slices_of(count, size).begin_of(rank);
}

/// Collective. The slices of a mesh that the first process has; it must pass the first line of the
/// invariants of struct Mesh, but for indices out of range. What the others pass is not looked at.
[[nodiscard]] MeshSlice share_out(const Mesh& mesh, const ProcessGroup& group);

/// Collective. The slices of a mesh file, which the first process reads and hands on as it goes.
/// Of the options only `note` is looked at, as by stream_mesh(). Throws, on all processes, as that
/// does.
[[nodiscard]] MeshSlice read_slice(const std::filesystem::path& path, const ReadOptions& options,
                                   const ProcessGroup& group);

/// Collective in the mesh's group, whose processes are those of the verifier's. The slices of a
/// mesh in several memories.
[[nodiscard]] MeshSlice slice_of(MeshSource& mesh);

}  // namespace octetra::verify
