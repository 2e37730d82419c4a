#pragma once

#include <string>

#include <octetra/core/mesh.hpp>

#include "properties/draw.hpp"

namespace octetra::properties {

struct NamedMesh {
    std::string kind;
    Mesh mesh;
};

/// A mesh of one cell to some hundred, the more the greater `size` (0 to 100), and made for
/// trouble: ties, slivers, several pieces, cells that meet at a vertex or an edge only, stretched,
/// far from the origin, tiny or huge. The verifier finds it valid.
[[nodiscard]] NamedMesh draw_mesh(Draw& draw, int size);

/// The same on a grid of 2^-16 within 16 of the origin: whatever is made of it by a few bisections
/// and translations by whole numbers is exact.
[[nodiscard]] NamedMesh draw_exact_mesh(Draw& draw, int size);

}  // namespace octetra::properties
