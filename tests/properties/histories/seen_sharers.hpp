#pragma once

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::properties {

/// Collective among the mesh's processes. On the first one, what they say wrongly of vertices,
/// edges and faces: who else has them, who owns them, which number they have, and in which order
/// two processes list what they share; held against what all cells of all processes show. Nothing
/// if all is right.
[[nodiscard]] std::string fault_of_seen_sharers(const distributed::AdaptiveMesh& mesh);

}  // namespace octetra::properties
