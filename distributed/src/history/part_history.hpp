#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cuts.hpp"

namespace octetra::distributed {

/// What was done to a process's part: its cells of the input, and how each step cut the cells that
/// there were then. See replay().
class PartHistory {
public:
    /// Of a part that is as the input was, and will have been cut so.
    explicit PartHistory(const DistributedMesh& input, std::vector<CutRuns> steps = {});

    /// A step of a planned level, to be recorded once that is committed.
    struct NewStep {
        std::size_t cell_count = 0;  ///< before it
        CutCells cuts;
        bool restores_order = false;
        std::vector<CutRuns> ordered;  ///< what was not in order before
    };
    /// Where this throws, nothing has changed. `cell_count` cells were there before the step. If
    /// it has brought the list into canonical order first, `before` are the numbers that the cells
    /// had, or empty where they kept them.
    [[nodiscard]] NewStep prepare(std::size_t cell_count, CutCells cuts, bool restores_order,
                                  const std::vector<CellIndex>& before);
    void commit(NewStep step) noexcept;

    /// All steps, each in the canonical order of the cells before it. `before` are the numbers of
    /// the present cells, in canonical order; empty where they are in this order.
    [[nodiscard]] std::vector<CutRuns> steps(const std::vector<CellIndex>& before) const;

    /// The steps up to where the list ceased to be in canonical order.
    [[nodiscard]] const std::vector<CutRuns>& ordered_steps() const { return steps_; }

    /// The part of the input that `mesh` was refined from.
    [[nodiscard]] DistributedMesh input_of(const DistributedMesh& mesh) const;

private:
    struct ListedStep {
        std::size_t cell_count = 0;  ///< before it
        std::vector<ListedCut> cuts;
    };
    [[nodiscard]] std::vector<CutRuns> in_order(const std::vector<CellIndex>& before) const;

    IndexVector<CellIndex, CellVertices> cells_;
    IndexVector<FacetIndex, FacetVertices> facets_;
    IndexVector<EdgeIndex, EdgeVertices> edges_;
    std::vector<Interface> interfaces_;
    std::vector<CutRuns> steps_;
    std::vector<ListedStep> listed_;  ///< the steps after these: since the list is in no order
};

}  // namespace octetra::distributed
