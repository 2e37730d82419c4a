#pragma once

#include "properties/draw_mesh.hpp"

namespace octetra::properties {

/// Draws a mesh of the generators: Delaunay meshes of points (random, on a lattice, on a sphere,
/// nearly on a lattice, graded), lattices, perturbed lattices, and prisms in layers of different
/// regions, by TetGen. Its size is a few units, near the origin. A lattice replaces a mesh in which
/// TetGen makes a flat cell or for which it fails.
[[nodiscard]] NamedMesh draw_shape(Draw& draw, int size);

}  // namespace octetra::properties
