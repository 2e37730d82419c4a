#pragma once

#include <cstddef>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "mark/selection_bounds.hpp"

namespace octetra::distributed {

/// Cells that stand together in a list, and a box that they are in: a selection by place need not
/// look into most of these blocks. Block b has cells b * size .. (b + 1) * size - 1. What comes in
/// the place of a cell must lie within it.
class CellBlocks {
public:
    static constexpr std::size_t size = 32;

    explicit CellBlocks(const DistributedMesh& mesh) { append(mesh, CellIndex{0}); }

    /// After this, append() does not fail for a mesh of so many cells.
    void make_room(std::size_t cell_count) {
        octetra::make_room(boxes_, (cell_count + size - 1) / size);
    }

    /// Takes in the mesh's cells from this one on.
    void append(const DistributedMesh& mesh, CellIndex begin);

    /// The mesh has become shorter.
    void truncate(std::size_t cell_count) { boxes_.resize((cell_count + size - 1) / size); }
    /// Looks at all cells again that a block has now.
    void renew(const DistributedMesh& mesh, std::size_t block);

    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

private:
    /// By the block's cells from this one on.
    void extend_by(const DistributedMesh& mesh, std::size_t block, CellIndex begin);

    std::vector<Box> boxes_;
};

}  // namespace octetra::distributed
