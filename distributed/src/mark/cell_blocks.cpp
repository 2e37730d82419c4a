#include "mark/cell_blocks.hpp"

#include <algorithm>

namespace octetra::distributed {

void CellBlocks::append(const DistributedMesh& mesh, CellIndex begin) {
    boxes_.resize((mesh.cells.size() + size - 1) / size, empty_box);
    for (CellIndex c = begin; c < mesh.cells.end_index();) {
        const std::size_t block = c.value() / size;
        extend_by(mesh, block, c);
        c = CellIndex{(block + 1) * size};
    }
}

void CellBlocks::add_replaced(const DistributedMesh& mesh, CellIndex cell) {
    Box& box = boxes_[cell.value() / size];
    for (const VertexIndex v : mesh.cells[cell]) extend(box, mesh.points[v]);
}

void CellBlocks::renew(const DistributedMesh& mesh, std::size_t block) {
    boxes_[block] = empty_box;
    extend_by(mesh, block, CellIndex{block * size});
}

void CellBlocks::extend_by(const DistributedMesh& mesh, std::size_t block, CellIndex begin) {
    Box box = boxes_[block];
    const CellIndex end{std::min((block + 1) * size, mesh.cells.size())};
    for (CellIndex c = begin; c < end; ++c) {
        for (const VertexIndex v : mesh.cells[c]) extend(box, mesh.points[v]);
    }
    boxes_[block] = box;
}

}  // namespace octetra::distributed
