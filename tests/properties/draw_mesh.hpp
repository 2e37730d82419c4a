#pragma once

#include <string>

#include <octetra/core/mesh.hpp>

#include "properties/draw.hpp"

namespace octetra::properties {

struct NamedMesh {
    std::string kind;
    Mesh mesh;
};

/// Draws a mesh of one cell to some hundred cells, growing with `size` (0 to 100), with degenerate
/// properties: ties, slivers, several components, cells that meet only at a vertex or an edge,
/// stretched, far from the origin, tiny or huge. The verifier finds it valid.
[[nodiscard]] NamedMesh draw_mesh(Draw& draw, int size);

/// The same on a grid of 2^-16 within 16 of the origin: a few bisections, and translations by whole
/// numbers, are exact.
[[nodiscard]] NamedMesh draw_exact_mesh(Draw& draw, int size);

}  // namespace octetra::properties
