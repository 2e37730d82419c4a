#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::rivals {

/// What one rank has of a mesh: whole cells and their vertices, and what numbers these have in the
/// whole mesh.
struct PartOfMesh {
    Mesh mesh;  ///< points, cells and regions
    IndexVector<VertexIndex, std::uint64_t> vertex_numbers;
    IndexVector<CellIndex, std::uint64_t> roots;  ///< of the input's cells that cells descend from
};

/// The cells of this part, in their order. Vertices of no cell are the first part's.
[[nodiscard]] PartOfMesh part_of(const Mesh& whole, const std::vector<int>& part_of_cell, int part);

}  // namespace octetra::rivals
