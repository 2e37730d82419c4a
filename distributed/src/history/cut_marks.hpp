#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cut_roots.hpp"
#include "level/marked_cells.hpp"

namespace octetra::distributed {

/// Converts the steps of a history, one after the other, to marks for refinement. Also works on a
/// mesh that is not in canonical order; only the descendants of roots that are cut are visited.
class CutMarks {
public:
    explicit CutMarks(CutRoots cuts);

    /// Returns whether the next step cuts every cell of this process at all six edges.
    [[nodiscard]] bool next_is_uniform(const DistributedMesh& mesh) const;
    /// Returns the marks of the next step, for a mesh to which all steps before have been applied.
    /// Throws InputError if the step records more or fewer cells than a root has descendants.
    [[nodiscard]] MarkedCells next(const DistributedMesh& mesh);
    /// Returns the marks of the next step, which must be uniform.
    [[nodiscard]] MarkedCells next_of_all(const DistributedMesh& mesh);

private:
    /// Returns the bytes of the next step of cut root `k` and advances beyond them.
    std::span<const std::uint8_t> take(std::size_t k);

    CutRoots cuts_;
    std::vector<std::size_t> at_;  ///< for each cut root, the offset of its next step
};

}  // namespace octetra::distributed
