#pragma once

#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>

/// The relation of a refined mesh to its input.
namespace octetra {

struct RefinementMaps {
    /// For each cell of the refined mesh, the cell of the input that contains it.
    IndexVector<CellIndex, CellIndex> cell_to_parent;
    /// The index of the first midpoint, equal to the number of vertices of the input.
    VertexIndex first_midpoint{0};
    /// Vertex first_midpoint + i is the midpoint of edge i of this list, smaller end first. Both
    /// ends are vertices of the refined mesh with lower numbers.
    std::vector<EdgeVertices> midpoint_to_edge;

    friend bool operator==(const RefinementMaps&, const RefinementMaps&) = default;
};

}  // namespace octetra
