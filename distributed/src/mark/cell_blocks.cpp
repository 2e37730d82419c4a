#include "mark/cell_blocks.hpp"

namespace octetra::distributed {

void CellBlocks::append(const DistributedMesh& mesh, CellIndex begin) {
    boxes_.resize((mesh.cells.size() + size - 1) / size, empty_box);
    for (CellIndex c = begin; c < mesh.cells.end_index(); ++c) {
        for (const VertexIndex v : mesh.cells[c]) extend(boxes_[c.value() / size], mesh.points[v]);
    }
}

}  // namespace octetra::distributed
