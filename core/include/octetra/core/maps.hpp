#pragma once

#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>

/// How a refined mesh descends from its input.
namespace octetra {

struct RefinementMaps {
    /// For each cell of the refined mesh, the cell of the input that it lies in.
    IndexVector<CellIndex, CellIndex> cell_to_parent;
    /// The vertex that midpoint number 0 became: the number of the input's vertices.
    VertexIndex first_midpoint{0};
    /// Vertex first_midpoint + i is the midpoint of edge i here, smaller end point first. Both ends
    /// are vertices of the refined mesh with lower numbers.
    std::vector<EdgeVertices> midpoint_to_edge;

    friend bool operator==(const RefinementMaps&, const RefinementMaps&) = default;
};

}  // namespace octetra
