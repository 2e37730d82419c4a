#include "history/coarsen.hpp"

#include <optional>
#include <utility>

#include "history/collapse.hpp"
#include "history/kept_vertices.hpp"
#include "pattern/coarser_pattern.hpp"

namespace octetra::distributed {
namespace {

/// A step as it was, and what is left of it: of each cell that it cut, the edges.
struct EditedStep {
    std::size_t cell_count = 0;  ///< before the step
    std::vector<CollapsedCell> cut;
    std::vector<EdgeMask> edges_left;
};

/// Collective. The steps, first to last; finds all vertices that stay.
std::vector<EditedStep> edited_steps(const DistributedMesh& mesh, std::span<const CutRuns> steps,
                                     KeptVertices* kept, LocalFailure& failure) {
    std::vector<EditedStep> edited;
    IndexVector<CellIndex, CellVertices> cells;
    failure.attempt([&] {
        edited.resize(steps.size());
        cells = mesh.cells;
    });
    // All processes have as many steps as there are levels.
    for (std::size_t t = mesh.level_begin.size(); t-- > 0;) {
        CollapsedStep before;
        failure.attempt([&] {
            before = collapse(cells, steps[t], mesh.level_begin[t], mesh.points);
            for (const CollapsedCell& cell : before.cut) kept->keep(before.cells[cell.cell]);
        });
        if (!close_together(kept, before.cut, mesh, failure)) return {};
        failure.attempt([&] {
            cells = std::move(before.cells);
            edited[t].cell_count = cells.size();
            edited[t].cut = std::move(before.cut);
            for (const CollapsedCell& cell : edited[t].cut) {
                edited[t].edges_left.push_back(kept->kept_edges(cell));
            }
        });
    }
    return edited;
}

/// The coarser mesh beside the finer one, as they are before a step.
struct Correspondence {
    /// For each cell of the coarser mesh the same one of the finer, or none() where it has pieces.
    IndexVector<CellIndex, CellIndex> same;
    /// For each cell of the finer mesh the one of the coarser that it lies in, and how often that
    /// was halved for it.
    IndexVector<CellIndex, CellIndex> around;
    IndexVector<CellIndex, std::uint8_t> halvings;
};

Correspondence of_input(std::size_t cell_count) {
    Correspondence cells;
    for (std::size_t c = 0; c < cell_count; ++c) cells.same.push_back(CellIndex{c});
    cells.around = cells.same;
    cells.halvings.assign(cell_count, 0);
    return cells;
}

/// What is left of a step, and the cells after it.
class Edit {
public:
    Edit(const EditedStep& step, const Correspondence& before) : step_(&step), before_(&before) {
        cut_.assign(step.cell_count, not_cut);
        for (std::size_t k = 0; k < step.cut.size(); ++k) {
            cut_[step.cut[k].cell] = static_cast<std::uint32_t>(k);
        }
        std::size_t next = 0;
        for (const std::uint32_t k : cut_) {
            first_child_.append(CellIndex{next});
            next += k == not_cut ? 1 : child_count_of(step.cut[k].cut);
        }
        after_.around.resize(next);
        after_.halvings.resize(next);
        make();
    }

    [[nodiscard]] CutRuns left() && { return std::move(left_); }
    [[nodiscard]] Correspondence after() && { return std::move(after_); }

private:
    static constexpr std::uint32_t not_cut = CellIndex::none_value;

    void make() {
        IndexVector<CellIndex, CellIndex> first_piece;  // of each cell of the coarser mesh
        for (const CellIndex same : before_->same) {
            first_piece.append(after_.same.end_index());
            if (same.is_none() || cut_[same] == not_cut) {
                left_.append(0);
                after_.same.append(same.is_none() ? same : first_child_[same]);
            } else {
                divide(step_->cut[cut_[same]], step_->edges_left[cut_[same]]);
            }
        }
        left_.finish();
        for (CellIndex c{0}; c < cut_.end_index(); ++c) {
            if (cut_[c] != not_cut) continue;
            after_.around[first_child_[c]] = first_piece[before_->around[c]];
            after_.halvings[first_child_[c]] = before_->halvings[c];
        }
    }
    void divide(const CollapsedCell& cell, EdgeMask edges) {
        const CellIndex begin = after_.same.end_index();
        const CoarserPattern pattern = coarser_pattern(cell.order, edges_of(cell.cut), edges);
        left_.append(edges == 0 ? Cut{0} : cut_into(edges, pattern.child_count));
        for (std::size_t j = 0; j < pattern.child_count; ++j) {
            const std::size_t k = pattern.same_child[j];
            after_.same.append(k == CoarserPattern::none ? CellIndex::none() : child(cell, k));
        }
        for (std::size_t k = 0; k < child_count_of(cell.cut); ++k) {
            after_.around[child(cell, k)] = CellIndex{begin.value() + pattern.child_around[k]};
            after_.halvings[child(cell, k)] = pattern.halvings[k];
        }
    }
    [[nodiscard]] CellIndex child(const CollapsedCell& cell, std::size_t k) const {
        return CellIndex{first_child_[cell.cell].value() + k};
    }

    const EditedStep* step_;
    const Correspondence* before_;
    IndexVector<CellIndex, std::uint32_t> cut_;  ///< of each cell, which of those cut it is
    IndexVector<CellIndex, CellIndex> first_child_;
    CutRuns left_;
    Correspondence after_;
};

std::uint64_t count_cut(const CutRuns& step) {
    std::uint64_t count = 0;
    for_each_run(step, [&](Cut cut, std::uint64_t cells) { count += cut == 0 ? 0 : cells; });
    return count;
}

/// Collective. Drops the steps that no process has anything left of.
void drop_empty(const Communicator& processes, std::vector<CutRuns>& steps, LocalFailure& failure) {
    std::vector<std::uint64_t> cut_cells;
    failure.attempt([&] {
        for (const CutRuns& step : steps) cut_cells.push_back(count_cut(step));
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return;
    processes.sum(cut_cells);
    std::size_t left = 0;
    for (std::size_t t = 0; t < steps.size(); ++t) {
        if (cut_cells[t] > 0) std::swap(steps[left++], steps[t]);
    }
    steps.resize(left);
}

}  // namespace

Coarser coarsen(const DistributedMesh& mesh, std::span<const CutRuns> steps,
                std::span<const std::uint8_t> may_go, LocalFailure& failure) {
    std::optional<KeptVertices> kept;
    failure.attempt([&] {
        kept.emplace(mesh);
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            if (may_go[c.value()] == 0) kept->keep(mesh.cells[c]);
        }
    });
    const auto edited = edited_steps(mesh, steps, kept ? &*kept : nullptr, failure);
    Coarser coarser;
    failure.attempt([&] {
        Correspondence cells = of_input(mesh.cell_ancestors.roots.size());
        for (const EditedStep& step : edited) {
            Edit edit(step, cells);
            coarser.steps.push_back(std::move(edit).left());
            cells = std::move(edit).after();
        }
        for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
            if (kept->has(v)) coarser.vertices_before.push_back(v);
        }
        coarser.cell_after = std::move(cells.around);
        coarser.halvings = std::move(cells.halvings);
    });
    drop_empty(mesh.processes, coarser.steps, failure);
    return coarser;
}

}  // namespace octetra::distributed
