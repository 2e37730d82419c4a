#pragma once

#include <span>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The canonical (global) numbers of a process's vertices.
struct CanonicalNumbers {
    IndexVector<VertexIndex, GlobalVertex> of_vertex;
    std::uint64_t vertex_count = 0;  ///< in the whole mesh

    /// Collective. Numbers the midpoints of one more level, the next ones of this process's
    /// vertices, by the ends of the edges that they halve. They are ordered by the numbers of these
    /// ends; see append_ranked(). `shared_vertices` are the numbered vertices that other processes
    /// have, too, ascending. To be called within a transaction; if that fails, the new numbers must
    /// be removed by forget_from().
    void number_midpoints(const Communicator& processes, std::span<const EdgeVertices> ends,
                          std::span<const VertexIndex> shared_vertices);

    /// Removes the numbers from `end` on and resets vertex_count to `count`.
    void forget_from(VertexIndex end, std::uint64_t count) noexcept;
};

/// Returns the ends of the edges that the midpoints of a level, counted from 0, halve.
[[nodiscard]] std::span<const EdgeVertices> midpoint_ends(const DistributedMesh& mesh,
                                                          std::size_t level);

/// Returns the numbers of the input vertices. Not collective.
[[nodiscard]] CanonicalNumbers input_numbers(const DistributedMesh& mesh);

/// Collective. Returns the numbers of all vertices of this process.
[[nodiscard]] CanonicalNumbers canonical_numbers(const DistributedMesh& mesh);

}  // namespace octetra::distributed
