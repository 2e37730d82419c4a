#pragma once

#include <functional>
#include <vector>

#include <octetra/distributed/ghosts.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. `regions` makes the tags of this process's cells.
[[nodiscard]] GhostLayer find_ghosts(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     const Sharing<VertexIndex>& sharing,
                                     const std::function<std::vector<Marker>()>& regions,
                                     GhostsBy by);

}  // namespace octetra::distributed
