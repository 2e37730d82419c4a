#include "mark/cell_blocks.hpp"

#include <algorithm>

namespace octetra::distributed {

void CellBlocks::append(const DistributedMesh& mesh, CellIndex begin) {
    boxes_.resize((mesh.cells.size() + size - 1) / size, empty_box);
    for (CellIndex c = begin; c < mesh.cells.end_index(); ++c) {
        for (const VertexIndex v : mesh.cells[c]) extend(boxes_[c.value() / size], mesh.points[v]);
    }
}

void CellBlocks::renew(const DistributedMesh& mesh, std::size_t block) {
    boxes_[block] = empty_box;
    const CellIndex end{std::min((block + 1) * size, mesh.cells.size())};
    for (CellIndex c{block * size}; c < end; ++c) {
        for (const VertexIndex v : mesh.cells[c]) extend(boxes_[block], mesh.points[v]);
    }
}

}  // namespace octetra::distributed
