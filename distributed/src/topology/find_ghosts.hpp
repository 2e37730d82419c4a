#pragma once

#include <vector>

#include <octetra/distributed/ghosts.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Returns the ghosts of this process. `regions` are the tags of its cells, or empty if
/// there are none.
[[nodiscard]] GhostLayer find_ghosts(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     const Sharing<VertexIndex>& sharing,
                                     const std::vector<Marker>& regions, GhostsBy by);

}  // namespace octetra::distributed
