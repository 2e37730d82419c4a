#pragma once

#include <octetra/core/mesh.hpp>

namespace octetra::generator {

/// Lists the faces of cells that lie in a side of the box from the origin to `high` as facets, with
/// the markers that kuhn() promises, in the order of the cells. A corner belongs to a side when the
/// coordinate is equal, bit for bit.
void list_box_sides(Mesh& mesh, const Point& high);

}  // namespace octetra::generator
