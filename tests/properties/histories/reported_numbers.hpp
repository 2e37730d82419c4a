#pragma once

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::properties {

/// Collective among the mesh's processes. On the first one, whose `whole` is the collected mesh:
/// describes numbers, points or cells that a process reports wrongly. Empty if there are none.
[[nodiscard]] std::string fault_of_reported_numbers(const distributed::AdaptiveMesh& mesh,
                                                    const Mesh& whole);

}  // namespace octetra::properties
