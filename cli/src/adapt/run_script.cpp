#include "adapt/run_script.hpp"

#include <algorithm>
#include <cstdint>
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

class Runner {
public:
    /// `is_last`: no later step changes the mesh.
    Runner(AdaptiveMesh& mesh, const ScriptRun& run, bool is_refined_before, bool is_last)
        : mesh_(&mesh), run_(&run), is_refined_before_(is_refined_before), is_last_(is_last) {}

    StepDone operator()(RefineStep step) {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        distributed::StepOptions options = run_->options;
        options.scheme = step.scheme;
        options.is_last = is_last_ && levels == 1;
        const int done = refine(*mesh_, step, options, run_->balance, followers(levels));
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
        const distributed::Migration move = mesh_->rebalance();
        if (!move.changed()) {
            return {fmt::format("rebalanced, and no cell moved: most/mean cells {:.2f}", before),
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
};

bool changes_cells(const ScriptStep& step) {
    return std::holds_alternative<RefineStep>(step.step) ||
           std::holds_alternative<CoarsenStep>(step.step);
}

}  // namespace

void run_script(AdaptiveMesh& mesh, const Script& script, const ScriptRun& run, Stopwatch& watch) {
    Counts before = counts_of(mesh);
    bool is_refined = run.has_steps;
    auto changing = std::ranges::count_if(script.steps, changes_cells);  // steps still to come
    for (const ScriptStep& step : script.steps) {
        if (changes_cells(step)) --changing;
        StepDone done;
        try {
            done = std::visit(Runner(mesh, run, is_refined, changing == 0), step.step);
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
