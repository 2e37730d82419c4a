#pragma once

#include <octetra/core/shape.hpp>

/// Sizes and angles of triangles and tetrahedra.
namespace octetra::quality {

using octetra::area;
using octetra::corner_angles;
using octetra::dihedral_angles;
using octetra::distance;
using octetra::mean_ratio;
using octetra::Triangle;

}  // namespace octetra::quality
