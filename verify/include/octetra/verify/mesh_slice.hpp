#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/group.hpp>

namespace octetra::verify {

/// How many entities a whole mesh has.
struct Totals {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< listed ones
};

/// What one process has of a mesh that is in several memories: of each list a stretch, process
/// after process. Of `count` entities process r of n has those from slice_begin(count, r, n) on.
struct MeshSlice {
    Mesh lists;  ///< the stretches; vertices are numbered as in the whole mesh
    Totals totals;
};

[[nodiscard]] constexpr std::uint64_t slice_begin(std::uint64_t count, int rank, int size) {
    const auto r = static_cast<std::uint64_t>(rank);
    const auto n = static_cast<std::uint64_t>(size);
    return count / n * r + count % n * r / n;
}

/// Collective. The slices of a mesh that the first process has; it must pass the first line of the
/// invariants of struct Mesh, but for indices out of range. What the others pass is not looked at.
[[nodiscard]] MeshSlice share_out(const Mesh& mesh, const Group& group);

}  // namespace octetra::verify
