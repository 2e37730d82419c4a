#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_roots.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// The cells that the steps of a history cut, one step after the other, as marks to refine by. A
/// mesh in no order stays so: only the descendants of roots that are cut are looked at.
class CutMarks {
public:
    explicit CutMarks(CutRoots cuts);

    /// Does the next step cut every cell of this process at all six edges?
    [[nodiscard]] bool next_is_uniform(const DistributedMesh& mesh) const;
    /// The next step, of a mesh that all before it have been done to. Throws InputError where it
    /// tells of more or fewer cells than a root has become.
    [[nodiscard]] MarkedCells next(const DistributedMesh& mesh);
    /// The next step, which is known to be uniform.
    [[nodiscard]] MarkedCells next_of_all(const DistributedMesh& mesh);

private:
    /// The next step's bytes of a cut root; the step after begins behind them.
    std::span<const std::uint8_t> take(std::size_t k);

    CutRoots cuts_;
    std::vector<std::size_t> at_;  ///< of each root the byte that its next step begins with
};

}  // namespace octetra::distributed
