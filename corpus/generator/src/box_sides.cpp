#include "box_sides.hpp"

#include <algorithm>
#include <array>

#include "outward_faces.hpp"

namespace octetra::generator {
namespace {

using Triangle = std::array<Point, 3>;

bool all_at(const Triangle& triangle, double Point::*axis, double coordinate) {
    return std::ranges::all_of(triangle, [=](const Point& p) { return p.*axis == coordinate; });
}

/// Returns the marker of the side that contains the triangle, or 0.
Marker side_of(const Triangle& triangle, const Point& high) {
    Marker side = 0;
    for (double Point::*const axis : {&Point::x, &Point::y, &Point::z}) {
        ++side;
        if (all_at(triangle, axis, 0)) return side;
        ++side;
        if (all_at(triangle, axis, high.*axis)) return side;
    }
    return 0;
}

}  // namespace

void list_box_sides(Mesh& mesh, const Point& high) {
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j, k] : outward_faces) {
            const FacetVertices face{cell[i], cell[j], cell[k]};
            const Marker side =
                side_of({mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]}, high);
            if (side == 0) continue;
            mesh.facets.push_back(face);
            mesh.facet_markers.push_back(side);
        }
    }
}

}  // namespace octetra::generator
