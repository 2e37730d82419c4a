#pragma once

#include <octetra/core/index.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "migrate/migration_messages.hpp"

namespace octetra::distributed {

/// Collective. The numbers in the whole mesh of the vertices that this process has after a move, of
/// those that it had before. Both ascend, so that of each but the difference to the one before it
/// is sent, in as few bytes as it takes.
[[nodiscard]] IndexVector<VertexIndex, GlobalVertex> moved_numbers(
    const Communicator& processes, const MovedEntities& moved,
    const IndexVector<VertexIndex, GlobalVertex>& numbers);

}  // namespace octetra::distributed
