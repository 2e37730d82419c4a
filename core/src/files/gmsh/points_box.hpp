#pragma once

#include <octetra/core/mesh_source.hpp>
#include <octetra/core/point.hpp>

namespace octetra::gmsh {

struct PointsBox {
    Point low;
    Point high;
};

/// Collective. The least box that has all points of a mesh; that of no points is a point. Zeros are
/// positive: else the signs in a file would depend on who had which points.
[[nodiscard]] PointsBox box_of_points(MeshSource& mesh);

}  // namespace octetra::gmsh
