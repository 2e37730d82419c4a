#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::rivals {

/// A rank's part of a mesh: cells with their vertices, and the global numbers of these vertices.
struct PartOfMesh {
    Mesh mesh;  ///< points, cells and regions
    IndexVector<VertexIndex, std::uint64_t> vertex_numbers;
    IndexVector<CellIndex, std::uint64_t> roots;  ///< global numbers of the cells' roots
};

/// Returns the cells of this part, in their order. Vertices of no cell belong to the first part.
[[nodiscard]] PartOfMesh part_of(const Mesh& whole, const std::vector<int>& part_of_cell, int part);

}  // namespace octetra::rivals
