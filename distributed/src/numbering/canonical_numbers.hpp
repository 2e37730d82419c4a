#pragma once

#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// The canonical numbers of a process's vertices.
struct CanonicalNumbers {
    IndexVector<VertexIndex, GlobalVertex> of_vertex;
    std::uint64_t vertex_count = 0;  ///< in the whole mesh

    /// Collective. Numbers the midpoints of one level more: of this process, the vertices from the
    /// last that has a number to before `end`. They come in the order of their ends' numbers, which
    /// processes put together that lower ends decide: see append_ranked(). `shared_vertices` are
    /// those with a number that other processes have too, ascending. Where a process fails, the
    /// numbers are not to be used on any until they have been taken back. False where that is
    /// known, on all alike: then no further level is to be numbered.
    [[nodiscard]] bool number_midpoints(const DistributedMesh& mesh, VertexIndex end,
                                        std::span<const VertexIndex> shared_vertices,
                                        LocalFailure& failure);

    /// Takes numbers back: `count` is what vertex_count was.
    void forget_from(VertexIndex end, std::uint64_t count) noexcept;
};

/// Of the vertices of the input alone. Not collective.
[[nodiscard]] CanonicalNumbers input_numbers(const DistributedMesh& mesh);

/// Collective. Of all vertices of this process.
[[nodiscard]] CanonicalNumbers canonical_numbers(const DistributedMesh& mesh);

}  // namespace octetra::distributed
