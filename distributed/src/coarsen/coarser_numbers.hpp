#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"
#include "comm/local_failure.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// The canonical numbers of the vertices that stay.
struct CoarserNumbers {
    /// Of before, the first that comes behind any that goes, here or elsewhere: those before it
    /// have their numbers still.
    VertexIndex first;
    std::vector<GlobalVertex> from_first;  ///< of those that stay
    std::uint64_t vertex_count = 0;        ///< in the whole mesh
};

/// Collective. Vertices are numbered by level, and by their ends' numbers within one; so those that
/// stay are in the same order when others go, and each number becomes less by as many as go of the
/// vertices before it, on whatever process. Each is asked about at a process that the number
/// decides, and its owner tells of one that goes. Where a process has failed or fails, the result
/// is not to be used on any.
[[nodiscard]] CoarserNumbers coarser_numbers(const Communicator& processes,
                                             const CanonicalNumbers& numbers,
                                             const Sharing<VertexIndex>& sharing,
                                             const KeptVertices& kept, const CoarserPart& part,
                                             LocalFailure& failure);

void commit_numbers(const CoarserNumbers& after, const CoarserPart& part,
                    CanonicalNumbers& numbers) noexcept;

}  // namespace octetra::distributed
