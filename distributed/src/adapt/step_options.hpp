#pragma once

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Throws InputError unless all processes have the same options:
/// with different ones they would make meshes that do not fit each other, or deadlock.
void check_same(const Communicator& processes, const StepOptions& options);
void check_same(const Communicator& processes, const BalanceOptions& options);

}  // namespace octetra::distributed
