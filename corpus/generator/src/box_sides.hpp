#pragma once

#include <octetra/core/mesh.hpp>

namespace octetra::generator {

/// Lists the faces of cells on the sides of the box from the origin to `high` as facets, with the
/// markers of kuhn(), in the order of the cells. A corner belongs to a side if its coordinate is
/// exactly equal.
void list_box_sides(Mesh& mesh, const Point& high);

}  // namespace octetra::generator
