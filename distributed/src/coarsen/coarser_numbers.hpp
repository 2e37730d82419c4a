#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/sharing.hpp>

#include "coarsen/coarser_part.hpp"
#include "coarsen/kept_vertices.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// The global numbers of the remaining vertices.
struct CoarserNumbers {
    /// The first vertex, by its previous local number, with a global number greater than or equal
    /// to that of a removed vertex of any process: those before it keep their numbers.
    VertexIndex first;
    std::vector<GlobalVertex> from_first;  ///< of the remaining vertices
    std::uint64_t vertex_count = 0;        ///< in the whole mesh
};

/// Collective. Determines new global numbers. Vertices are numbered by level, and within a level by
/// the numbers of their ends; so the order of the remaining vertices does not change, and each
/// number decreases by the number of removed vertices before it, on any process. Each new number is
/// requested from the rank whose block of numbers has the old one; owners report removed vertices
/// to it.
[[nodiscard]] CoarserNumbers coarser_numbers(const Communicator& processes,
                                             const CanonicalNumbers& numbers,
                                             const Sharing<VertexIndex>& sharing,
                                             const KeptVertices& kept, const CoarserPart& part);

void commit_numbers(const CoarserNumbers& after, const CoarserPart& part,
                    CanonicalNumbers& numbers) noexcept;

}  // namespace octetra::distributed
