#pragma once

#include <string_view>

#include <octetra/core/mesh.hpp>

#include "complex.hpp"

namespace octetra::generator {

/// Generates TetGen's mesh of the complex, with `switches` as in its manual. A complex without
/// facets yields the Delaunay mesh of its points, with the hull's faces as facets of marker 1.
/// Every cell is positively oriented, exactly. Throws InputError if TetGen fails, and SystemError
/// if memory is exhausted.
///
/// TetGen runs in a separate process, because version 1.5.0 frees its memory twice on failure and
/// aborts at assertions; both would end the program without a message.
[[nodiscard]] Mesh tetrahedralise(const Complex& complex, std::string_view switches);

/// Whether TetGen may insert vertices on the facets of the complex.
enum class Surface { as_given, may_be_cut };

/// Generates a mesh of good quality, as far as TetGen can achieve it: circumspheres no larger than
/// 1.414 times the cell's shortest edge, dihedral angles of at least 10 degrees, and no cell larger
/// than a regular one with this edge length. Cells at a surface that must not be modified may
/// violate all three.
[[nodiscard]] Mesh fill(const Complex& complex, double edge_length, Surface surface);

}  // namespace octetra::generator
