#pragma once

#include <octetra/core/index.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "migrate/migration_messages.hpp"

namespace octetra::distributed {

/// Collective. Returns the global numbers of this process's vertices after a migration, from those
/// before it. Numbers ascend within each message, so only differences are sent, as numbers of
/// variable length.
[[nodiscard]] IndexVector<VertexIndex, GlobalVertex> moved_numbers(
    const Communicator& processes, const MovedEntities& moved,
    const IndexVector<VertexIndex, GlobalVertex>& numbers);

}  // namespace octetra::distributed
