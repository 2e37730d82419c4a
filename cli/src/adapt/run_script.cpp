#include "adapt/run_script.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/run_steps.hpp"
#include "adapt/step_texts.hpp"
#include "adapt/write_result.hpp"
#include "commands/mesh_options.hpp"
#include "commands/report_line.hpp"

namespace octetra::cli {
namespace {

using distributed::AdaptiveMesh;

struct Counts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
};

/// Collective. Returns the global numbers of vertices and cells.
Counts counts_of(const AdaptiveMesh& mesh) {
    return {mesh.vertex_count(), mesh.processes().sum(mesh.cells().size())};
}

/// Collective. Returns the ratio of the maximum to the mean number of cells of a rank.
double most_over_mean(const AdaptiveMesh& mesh) {
    const std::uint64_t here = mesh.cells().size();
    const auto all = static_cast<double>(mesh.processes().sum(here));
    return static_cast<double>(mesh.processes().max(here)) * mesh.processes().size() / all;
}

constexpr std::string_view uneven_parts_reason =
    " (--series records the origin of cells at each step, so cells of the input move whole)";

/// Collective. Restores the history that was discarded to move cells.
void recall_history(AdaptiveMesh& mesh, const ScriptRun& run) {
    while (mesh.has_forgotten_history()) {
        const distributed::Migration move = mesh.recall_history();
        if (run.on_move) run.on_move(move);
    }
}

/// Collective. As above, then rebalances the cells that were moved only for this.
void recall_history_and_balance(AdaptiveMesh& mesh, const ScriptRun& run) {
    if (!mesh.has_forgotten_history()) return;
    recall_history(mesh, run);
    if (!run.balance) return;
    const distributed::Migration move =
        mesh.rebalance({.most_over_mean = run.balance->most_over_mean});
    if (move.changed() && run.on_move) run.on_move(move);
}

class Runner {
public:
    /// `is_last` means that no further step changes the mesh.
    Runner(AdaptiveMesh& mesh, const ScriptRun& run, bool is_refined_before, bool is_last)
        : mesh_(&mesh),
          run_(&run),
          is_refined_before_(is_refined_before),
          is_last_(is_last),
          balance_(run.balance) {
        if (balance_) balance_->may_forget_history = run.may_forget_history;
    }

    StepDone operator()(RefineStep step) {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        distributed::StepOptions options = run_->options;
        options.scheme = step.scheme;
        options.closure = step.closure;
        options.is_last = is_last_ && levels == 1;
        const bool has_target = step.typed.target_cells.has_value();
        const RefinedLevels done =
            refine(*mesh_, step, options, balance_, followers(has_target ? 0 : levels));
        StepDone report{levels_done("refined", done.count), {}};
        if (done.refined < done.marked) {
            report.remarks.push_back(reached_target(done.refined, done.marked));
        } else if (!has_target || done.count == 0) {
            report.remarks = idle_levels(done.count, levels, idle_refinement_reason);
        }
        return report;
    }

    StepDone operator()(CoarsenStep step) {
        complete(step.selection, step.typed.selection);
        recall_history_and_balance(*mesh_, *run_);
        const int levels = step.typed.levels;
        bool is_any_marked = false;
        const int done = coarsen(*mesh_, step, followers(levels), is_any_marked);
        return {
            levels_done("coarsened", done),
            idle_levels(done, levels, idle_coarsening_reason(is_refined_before_, is_any_marked))};
    }

    StepDone operator()(const FitStep& step) {
        recall_history_and_balance(*mesh_, *run_);
        distributed::StepOptions options = run_->options;
        options.scheme = step.scheme;
        options.closure = step.closure;
        const Fitted fitted = fit(*mesh_, step, options, run_->balance, followers(0));
        return {steps_fitted(fitted.refined, fitted.coarsened),
                misfits_of(fitted.misfits, is_refined_before_ || fitted.refined > 0)};
    }

    StepDone operator()(const RebalanceStep&) {
        const double before = most_over_mean(*mesh_);
        const bool may_forget = run_->may_forget_history;
        const distributed::Migration move = mesh_->rebalance({.may_forget_history = may_forget});
        if (!move.changed()) {
            const bool is_uneven = before > distributed::BalanceOptions{}.most_over_mean;
            return {fmt::format("rebalanced, and no cell moved: most/mean cells {:.2f}{}", before,
                                is_uneven && !may_forget ? uneven_parts_reason : ""),
                    {},
                    false};
        }
        if (run_->on_move) run_->on_move(move);
        return {fmt::format("rebalanced, most/mean cells {:.2f} to {:.2f}", before,
                            most_over_mean(*mesh_)),
                {},
                false};
    }

    StepDone operator()(const WriteStep& step) {
        if (records_origins(step.path)) recall_history_and_balance(*mesh_, *run_);
        return step_written(step.path, write_result(*mesh_, run_->fields->written(), step.path));
    }

private:
    [[nodiscard]] Followers followers(int levels) const {
        return {level_progress(run_->quiet, levels), run_->on_step, run_->on_move,
                is_refined_before_, run_->fields};
    }

    /// Collective. Completes the selection with the facts of the current mesh.
    void complete(Selection& selection, const SelectionOptions& typed) const {
        const std::uint64_t cells = counts_of(*mesh_).cells;
        const MeshFacts& input = run_->input;
        complete_selection(selection, typed, {input.index_base, cells, input.group_names},
                           mesh_->processes());
    }

    AdaptiveMesh* mesh_;
    const ScriptRun* run_;
    bool is_refined_before_;
    bool is_last_;
    std::optional<distributed::BalanceOptions> balance_;
};

bool changes_cells(const ScriptStep& step) {
    return closure_of(step.step) || std::holds_alternative<CoarsenStep>(step.step);
}

}  // namespace

void run_script(AdaptiveMesh& mesh, const Script& script, const ScriptRun& run, Stopwatch& watch) {
    Counts before = counts_of(mesh);
    bool is_refined = run.has_steps;
    std::span<const ScriptStep> remaining_steps(script.steps);
    for (const ScriptStep& step : script.steps) {
        remaining_steps = remaining_steps.subspan(1);
        StepDone done;
        try {
            const bool is_last = std::ranges::none_of(remaining_steps, changes_cells);
            done = std::visit(Runner(mesh, run, is_refined, is_last), step.step);
        } catch (const InputError& error) {
            throw wrong_line(script, step, error.what());
        }
        if (done.changes_mesh && run.on_changed) run.on_changed();
        const Counts after = counts_of(mesh);
        if (mesh.processes().is_first()) {
            const std::string was = sizes_before(before.vertices, before.cells);
            const std::string doing =
                script.path.empty()
                    ? done.what
                    : fmt::format("{}:{} {}", script.path.native(), step.line, done.what);
            report_line(run.quiet, doing, after.vertices, after.cells, watch.lap(),
                        done.changes_mesh ? was : "");
            for (const std::string& remark : done.remarks) {
                note(wrong_line(script, step, remark).what());
            }
        }
        is_refined = is_refined || after.cells != before.cells;
        before = after;
    }
    if (run.recalls_history) recall_history(mesh, run);
}

}  // namespace octetra::cli
