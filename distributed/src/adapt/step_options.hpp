#pragma once

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Throws InputError unless all processes have the same options:
/// with different ones they would make meshes that do not fit each other, or deadlock.
void check_same(const Communicator& processes, const StepOptions& options);
void check_same(const Communicator& processes, const BalanceOptions& options);

/// Throws InputError if the mesh was refined with another closure, or if the closure cannot be
/// combined with the scheme. The options must be the same on all processes.
void check_closure(const AdaptiveMesh::State& state, const StepOptions& options);

}  // namespace octetra::distributed
