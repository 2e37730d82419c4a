#pragma once

#include <string_view>

#include <octetra/core/mesh.hpp>

#include "complex.hpp"

namespace octetra::generator {

/// The mesh that TetGen makes of the complex, with `switches` as its manual calls them. A complex
/// of points alone becomes their Delaunay mesh, with the hull's faces as facets of marker 1.
/// Every cell is positively oriented, exactly. Throws InputError where TetGen fails, and
/// SystemError where memory ran out.
///
/// TetGen runs in a process of its own. Version 1.5.0 frees its memory twice when it gives up, and
/// stops at assertions; both would end the program without a word.
[[nodiscard]] Mesh tetrahedralise(const Complex& complex, std::string_view switches);

/// May TetGen put vertices on the facets of the complex?
enum class Surface { as_given, may_be_cut };

/// A mesh of good quality, as far as TetGen can reach it: circumspheres no larger than 1.414 times
/// the cell's shortest edge, dihedral angles of at least 10 degrees, and no cell larger than a
/// regular one with this edge length. Cells at a surface that must stay as given may miss all
/// three.
[[nodiscard]] Mesh fill(const Complex& complex, double edge_length, Surface surface);

}  // namespace octetra::generator
