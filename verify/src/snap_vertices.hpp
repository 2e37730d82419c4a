#pragma once

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// Moves each vertex of `mesh` to the nearest vertex of `target`, if their distance is at most
/// `tolerance`; among vertices at the same distance, to the one of the least coordinates. Returns
/// the greatest distance by which a vertex was moved.
[[nodiscard]] double snap_vertices(Mesh& mesh, const Mesh& target, double tolerance);

}  // namespace octetra::verify
