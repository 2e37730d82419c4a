#pragma once

#include <functional>
#include <vector>

#include <octetra/distributed/ghosts.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Returns the ghosts of this process. `regions` returns the tags of its cells.
[[nodiscard]] GhostLayer find_ghosts(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     const Sharing<VertexIndex>& sharing,
                                     const std::function<std::vector<Marker>()>& regions,
                                     GhostsBy by);

}  // namespace octetra::distributed
