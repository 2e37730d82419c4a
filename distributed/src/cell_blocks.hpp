#pragma once

#include <cstddef>
#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Could a cell whose corners are in the box be chosen for its place, by a sphere or a box? Exact
/// in that it never denies what rounding would make core's chooses() say.
[[nodiscard]] bool may_be_chosen(const Selection& selection, const Box& corners);

/// The smallest box with these corners.
[[nodiscard]] Box box_of(const Corners& corners);

/// Cells that stand together in a list, and a box that they are in: a selection by place need not
/// look into most of these blocks. Block b has cells b * size .. (b + 1) * size - 1. What comes in
/// the place of a cell must lie within it.
class CellBlocks {
public:
    static constexpr std::size_t size = 32;

    explicit CellBlocks(const DistributedMesh& mesh) { append(mesh, CellIndex{0}); }

    /// Takes in the mesh's cells from this one on.
    void append(const DistributedMesh& mesh, CellIndex begin);

    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

private:
    std::vector<Box> boxes_;
};

}  // namespace octetra::distributed
