#pragma once

#include "properties/draw_mesh.hpp"

namespace octetra::properties {

/// A mesh as the generators make it: Delaunay meshes of points (random, on a lattice, on a sphere,
/// nearly on a lattice, dense in one place), lattices, shaken lattices, and prisms in layers of
/// different regions, by TetGen. Some units large, and not far from the origin.
/// Where TetGen makes a flat cell or gives up, a lattice takes its place.
[[nodiscard]] NamedMesh draw_shape(Draw& draw, int size);

}  // namespace octetra::properties
