#pragma once

#include <cstddef>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "mark/selection_bounds.hpp"

namespace octetra::distributed {

/// Bounding boxes of blocks of consecutive cells, so that a geometric selection need not test the
/// cells of most blocks. Block b has the cells b * size .. (b + 1) * size - 1. A cell that replaces
/// another one must lie inside it.
class CellBlocks {
public:
    static constexpr std::size_t size = 32;

    explicit CellBlocks(const DistributedMesh& mesh) { append(mesh, CellIndex{0}); }

    /// Reserves capacity so that append() cannot fail for a mesh with this many cells.
    void make_room(std::size_t cell_count) {
        octetra::make_room(boxes_, (cell_count + size - 1) / size);
    }

    /// Adds the mesh's cells from `begin` on.
    void append(const DistributedMesh& mesh, CellIndex begin);

    /// A cell was replaced by one that need not lie inside it.
    void add_replaced(const DistributedMesh& mesh, CellIndex cell);
    /// The mesh has fewer cells.
    void truncate(std::size_t cell_count) { boxes_.resize((cell_count + size - 1) / size); }
    /// Recomputes the box of a block from its current cells.
    void renew(const DistributedMesh& mesh, std::size_t block);

    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

private:
    /// Extends the box of a block by its cells from `begin` on.
    void extend_by(const DistributedMesh& mesh, std::size_t block, CellIndex begin);

    std::vector<Box> boxes_;
};

}  // namespace octetra::distributed
