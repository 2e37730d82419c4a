#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/entity_transfer.hpp>

#include "level/transition_cells.hpp"

namespace octetra::distributed {

/// The children of the cells before a level by the numbers after it.
class Children {
public:
    /// `mesh` is the mesh after the level, whose order must not change during the lifetime of this
    /// object, and `level` the change of its cells.
    Children(const DistributedMesh& mesh, const EntityTransfer& level);

    /// Appends the children of a cell, or the cell itself if it was not bisected, in canonical
    /// order.
    void append_of(CellIndex before, CellRun& run) const;
    /// Returns the number after the level of a cell that was not bisected.
    [[nodiscard]] CellIndex same(CellIndex before) const {
        return keeps_numbers_ ? before : CellIndex{first_[before.value()]};
    }

private:
    [[nodiscard]] std::size_t count_of(CellIndex before) const;

    const DistributedMesh* mesh_;
    bool keeps_numbers_;
    /// The first child of each cell, then the number of children; empty if numbers are kept.
    std::vector<std::uint32_t> first_;
    /// The bisected cells, ascending, and the number of children of each, if numbers are kept.
    std::vector<std::pair<CellIndex, std::uint32_t>> counts_;
};

}  // namespace octetra::distributed
