#pragma once

#include <octetra/distributed/refine.hpp>

namespace octetra::distributed {

/// Collective. One level of refine(): level number `level`, counted from 1, for messages.
SynchronisationCounts refine_level(DistributedMesh& mesh, const Selection& selection,
                                   const RefineOptions& options, int level);

}  // namespace octetra::distributed
