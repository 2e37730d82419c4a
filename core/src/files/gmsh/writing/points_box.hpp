#pragma once

#include <octetra/core/mesh_source.hpp>
#include <octetra/core/point.hpp>

namespace octetra::gmsh {

struct PointsBox {
    Point low;
    Point high;
};

/// Collective. Returns the bounding box of all points of a mesh; a mesh without points has a single
/// point as its box. Zeros are positive, otherwise signs in a file would depend on the distribution
/// of the points.
[[nodiscard]] PointsBox box_of_points(MeshSource& mesh);

}  // namespace octetra::gmsh
