#pragma once

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::properties {

/// Collective among the mesh's processes. On the first one, whose `whole` is the mesh as it was
/// collected: what processes say wrongly of numbers, points and cells of theirs, or nothing.
[[nodiscard]] std::string fault_of_seen_numbers(const distributed::AdaptiveMesh& mesh,
                                                const Mesh& whole);

}  // namespace octetra::properties
