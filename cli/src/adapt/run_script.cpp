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
#include "adapt/step_words.hpp"
#include "adapt/write_result.hpp"
#include "commands/mesh_options.hpp"
#include "commands/report_line.hpp"
#include "grouped.hpp"

namespace octetra::cli {
namespace {

using distributed::AdaptiveMesh;

struct Counts {
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
};

/// Collective.
Counts counts_of(const AdaptiveMesh& mesh) {
    return {mesh.vertex_count(), mesh.processes().sum(mesh.cells().size())};
}

/// Collective. Of the cells of the ranks.
double most_over_mean(const AdaptiveMesh& mesh) {
    const std::uint64_t here = mesh.cells().size();
    const auto all = static_cast<double>(mesh.processes().sum(here));
    return static_cast<double>(mesh.processes().max(here)) * mesh.processes().size() / all;
}

constexpr std::string_view why_not_more_even =
    " (as long as a step or a file to come needs the history, a cell of the input moves whole)";

class Runner {
public:
    /// What is known of the steps to come.
    struct Rest {
        bool changes_mesh;
        bool needs_history;
    };

    Runner(AdaptiveMesh& mesh, const ScriptRun& run, bool is_refined_before, Rest rest)
        : mesh_(&mesh),
          run_(&run),
          is_refined_before_(is_refined_before),
          is_last_(!rest.changes_mesh),
          may_forget_(!rest.needs_history),
          balance_(run.balance) {
        if (balance_) balance_->may_forget_history = may_forget_;
    }

    StepDone operator()(RefineStep step) {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        distributed::StepOptions options = run_->options;
        options.scheme = step.scheme;
        options.is_last = is_last_ && levels == 1;
        const int done = refine(*mesh_, step, options, balance_, followers(levels));
        return {levels_done("refined", done), idle_levels(done, levels, why_not_finer)};
    }

    StepDone operator()(CoarsenStep step) {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        bool is_any_marked = false;
        const int done = coarsen(*mesh_, step, followers(levels), is_any_marked);
        return {levels_done("coarsened", done),
                idle_levels(done, levels, why_not_coarser(is_any_marked))};
    }

    StepDone operator()(const RebalanceStep&) {
        const double before = most_over_mean(*mesh_);
        const distributed::Migration move = mesh_->rebalance({.may_forget_history = may_forget_});
        if (!move.changed()) {
            const bool is_uneven = before > distributed::BalanceOptions{}.most_over_mean;
            return {fmt::format("rebalanced, and no cell moved: most/mean cells {:.2f}{}", before,
                                is_uneven && !may_forget_ ? why_not_more_even : ""),
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
        return {fmt::format("wrote {}", step.path), write_result(*mesh_, *run_->fields, step.path),
                false};
    }

private:
    [[nodiscard]] Followers followers(int levels) const {
        return {level_progress(run_->quiet, levels), run_->on_step, run_->on_move,
                is_refined_before_};
    }

    /// Collective.
    void complete(Selection& selection, const SelectionOptions& typed) const {
        const std::uint64_t cells = counts_of(*mesh_).cells;
        const MeshFacts& input = run_->input;
        complete_selection(selection, typed,
                           {input.has_regions, input.index_base, cells, input.group_names},
                           mesh_->processes());
    }

    AdaptiveMesh* mesh_;
    const ScriptRun* run_;
    bool is_refined_before_;
    bool is_last_;
    bool may_forget_;
    std::optional<distributed::BalanceOptions> balance_;
};

bool changes_cells(const ScriptStep& step) {
    return std::holds_alternative<RefineStep>(step.step) ||
           std::holds_alternative<CoarsenStep>(step.step);
}

/// To take cells back one must know what they came from, and some files say it.
bool needs_history(const ScriptStep& step) {
    const auto* const write = std::get_if<WriteStep>(&step.step);
    return std::holds_alternative<CoarsenStep>(step.step) ||
           (write != nullptr && tells_history(write->path));
}

Runner::Rest rest_of(std::span<const ScriptStep> steps, const ScriptRun& run) {
    return {std::ranges::any_of(steps, changes_cells),
            run.needs_history || std::ranges::any_of(steps, needs_history)};
}

}  // namespace

void run_script(AdaptiveMesh& mesh, const Script& script, const ScriptRun& run, Stopwatch& watch) {
    Counts before = counts_of(mesh);
    bool is_refined = run.has_steps;
    std::span<const ScriptStep> to_come(script.steps);
    for (const ScriptStep& step : script.steps) {
        to_come = to_come.subspan(1);
        StepDone done;
        try {
            done = std::visit(Runner(mesh, run, is_refined, rest_of(to_come, run)), step.step);
        } catch (const InputError& error) {
            throw wrong_line(script, step, error.what());
        }
        if (done.changes_mesh && run.on_changed) run.on_changed();
        const Counts after = counts_of(mesh);
        if (mesh.processes().is_first()) {
            const std::string was =
                fmt::format("  (before: {}, {})", grouped(before.vertices), grouped(before.cells));
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
}

}  // namespace octetra::cli
