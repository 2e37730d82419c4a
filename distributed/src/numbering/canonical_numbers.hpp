#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

struct CanonicalNumbers {
    IndexVector<VertexIndex, GlobalVertex> of_vertex;
    std::uint64_t vertex_count = 0;  ///< in the whole mesh
};

/// Collective. The canonical number of each vertex of this process. The midpoints of a level come
/// in the order of their ends' numbers; each pair of ends goes to a process that the lower end
/// decides, which puts its pairs in order and answers. Memory and messages are in proportion to the
/// vertices.
[[nodiscard]] CanonicalNumbers canonical_numbers(const DistributedMesh& mesh);

}  // namespace octetra::distributed
