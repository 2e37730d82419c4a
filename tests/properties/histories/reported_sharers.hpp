#pragma once

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::properties {

/// Collective among the mesh's processes. Compares the sharers, owner, number and order in the
/// interface that processes report for each vertex, edge and face with those computed from all
/// cells. Returns the first fault on the first process; empty if there is none.
[[nodiscard]] std::string fault_of_reported_sharers(const distributed::AdaptiveMesh& mesh);

}  // namespace octetra::properties
