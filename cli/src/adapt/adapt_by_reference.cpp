#include "adapt/adapt_by_reference.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/verify/mesh_slice.hpp>

#include "adapt/check_files.hpp"
#include "adapt/run.hpp"
#include "adapt/size_files.hpp"
#include "adapt/step_texts.hpp"
#include "commands/mesh_options.hpp"
#include "commands/report_line.hpp"
#include "commands/selection_options.hpp"
#include "script/check_script.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

using reference::CellMarks;
using reference::History;
using reference::Refinement;

/// Returns a refined mesh with the maps of its vertices, in which each cell is its own parent.
Refinement with_cells_as_parents(const Refinement& refined) {
    Refinement refinement = refined;
    refinement.maps.cell_to_parent.clear();
    for (CellIndex c{0}; c < refined.mesh.cells.end_index(); ++c) {
        refinement.maps.cell_to_parent.push_back(c);
    }
    return refinement;
}

bool is_any_marked(const CellMarks& marks) {
    return std::ranges::any_of(marks, [](char mark) { return mark != 0; });
}

/// A mesh and the history that created it from its input.
class AdaptedByReference {
public:
    AdaptedByReference(Mesh input, std::uint64_t max_cells)
        : history_{std::move(input), {}},
          refined_(reference::replay(history_).back()),
          max_cells_(max_cells) {}

    [[nodiscard]] const Mesh& mesh() const { return refined_.mesh; }
    /// Writes the mesh. Returns a sentence naming the data that the format cannot hold, or an empty
    /// string.
    [[nodiscard]] std::string write(const std::string& path) const {
        WholeMesh source(refined_.mesh, &refined_.maps);
        return write_mesh(source, path);
    }

    /// Returns whether any level has changed the mesh.
    [[nodiscard]] bool is_changed() const { return is_changed_; }

    /// Returns the number of levels that changed the mesh.
    int refine(const RefineStep& step, int levels) {
        if (step.closure == Closure::regular) return refine_regularly(step.selection, levels);
        const Selection& selection = step.selection;
        const Scheme scheme = step.scheme;
        // A list of cells refers to the mesh before the first level, and to their descendants
        // later.
        Refinement since = with_cells_as_parents(refined_);
        return repeat(levels, [&] {
            const CellMarks marks = reference::marked_cells(since, selection);
            if (!take(reference::refined(history_, marks, scheme))) return false;
            IndexVector<CellIndex, CellIndex> ancestors;
            for (const CellIndex parent : parents_after(since.mesh, marks, scheme)) {
                ancestors.push_back(since.maps.cell_to_parent[parent]);
            }
            since = refined_;
            since.maps.cell_to_parent = std::move(ancestors);
            return true;
        });
    }

    int refine_regularly(const Selection& selection, int levels) {
        if (!selection.cells.empty() && levels > 1) {
            throw InputError(
                "--engine reference does not support --cells with several levels of the regular "
                "closure");
        }
        closure_ = Closure::regular;
        return repeat(levels, [&] {
            const CellMarks marks =
                reference::marked_cells(with_cells_as_parents(refined_), selection);
            return take(reference::refined_regularly(history_, marks));
        });
    }

    /// As above, for coarsening. Sets `is_any` to whether the last level marked any cell.
    int coarsen(const Selection& selection, bool outside, int levels, bool& is_any) {
        return repeat(levels, [&] {
            CellMarks marks = reference::marked_cells(with_cells_as_parents(refined_), selection);
            if (outside) {
                for (char& mark : marks) mark = mark == 0 ? 1 : 0;
            }
            is_any = is_any_marked(marks);
            return take(reference::coarsened(history_, marks, closure_));
        });
    }

private:
    /// Repeats levels of a step until one changes nothing. Returns the number that changed the
    /// mesh.
    int repeat(int levels, const std::function<bool()>& take_level) {
        const bool was_changed = is_changed_;
        for (int level = 1; level <= levels; ++level) {
            try {
                if (!take_level()) return level - 1;
            } catch (const InputError& error) {
                if (!was_changed) throw;
                throw InputError(with_level(error.what(), level, levels));
            }
        }
        return levels;
    }

    /// Returns the parent of each cell after refinement of the marked cells.
    [[nodiscard]] static IndexVector<CellIndex, CellIndex> parents_after(const Mesh& mesh,
                                                                         const CellMarks& marks,
                                                                         Scheme scheme) {
        Selection listed;
        for (CellIndex c{0}; c < marks.end_index(); ++c) {
            if (marks[c] != 0) listed.cells.push_back(GlobalCell{c.value()});
        }
        return reference::refine(mesh, listed, scheme, 1).maps.cell_to_parent;
    }

    /// Replaces the history; returns whether this changes the mesh.
    bool take(History next) {
        if (next.steps == history_.steps) return false;
        refined_ = std::move(reference::replay(next, max_cells_).back());
        history_ = std::move(next);
        is_changed_ = true;
        return true;
    }

    History history_;
    Refinement refined_;  ///< the mesh, with the maps from its input
    std::uint64_t max_cells_;
    Closure closure_ = Closure::longest_edge;
    bool is_changed_ = false;
};

/// Executes a step with the serial reference.
class ReferenceRunner {
public:
    explicit ReferenceRunner(AdaptedByReference& adapted) : adapted_(&adapted) {}

    StepDone operator()(RefineStep step) const {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        const int done = adapted_->refine(step, levels);
        return {levels_done("refined", done), idle_levels(done, levels, idle_refinement_reason)};
    }
    StepDone operator()(CoarsenStep step) const {
        complete(step.selection, step.typed.selection);
        const int levels = step.typed.levels;
        bool is_any = false;
        const int done = adapted_->coarsen(step.selection, step.typed.outside, levels, is_any);
        return {levels_done("coarsened", done),
                idle_levels(done, levels, idle_coarsening_reason(adapted_->is_changed(), is_any))};
    }
    StepDone operator()(const FitStep&) const {
        throw InputError(
            "--engine reference cannot fit: the default engine makes the same mesh as the steps "
            "that docs/cli.md describes");
    }
    StepDone operator()(const RebalanceStep&) const {
        return {"rebalanced, and no cell moved: most/mean cells 1.00", {}, false};
    }
    StepDone operator()(const WriteStep& step) const {
        return step_written(step.path, adapted_->write(step.path));
    }

private:
    void complete(Selection& selection, const SelectionOptions& typed) const {
        const Mesh& mesh = adapted_->mesh();
        complete_selection(
            selection, typed,
            {mesh.index_base, mesh.cells.size(), SharedGroupNames(mesh.group_names)});
    }

    AdaptedByReference* adapted_;
};

void refuse_what_the_reference_lacks(const AdaptationOptions& options, const Script& script) {
    if (!options.input.fields.empty() || !options.series.empty() || options.verify ||
        !options.profile.profile.empty() || !options.profile.trace.empty()) {
        throw InputError(
            "--fields, --series, --verify, --profile and --trace cannot be combined with --engine "
            "reference, which creates only the mesh");
    }
    if (has_size_file(script)) throw InputError(std::string(reference_lacks_size_files));
    constexpr std::string_view reason =
        "--engine reference records no history and cannot be combined with .octetra files; the "
        "default engine makes the same mesh";
    if (is_checkpoint(options.input.path) || is_checkpoint(options.output)) {
        throw InputError(std::string(reason));
    }
    for (const ScriptStep& step : script.steps) {
        const auto* write = std::get_if<WriteStep>(&step.step);
        if (write != nullptr && is_checkpoint(write->path)) throw wrong_line(script, step, reason);
    }
}

void run_steps(AdaptedByReference& adapted, const Script& script, bool quiet, Stopwatch& watch) {
    for (const ScriptStep& step : script.steps) {
        const Mesh& mesh = adapted.mesh();
        const std::string was = sizes_before(mesh.points.size(), mesh.cells.size());
        StepDone done;
        try {
            done = std::visit(ReferenceRunner(adapted), step.step);
        } catch (const InputError& error) {
            throw wrong_line(script, step, error.what());
        }
        report_line(quiet, fmt::format("{}:{} {}", script.path.native(), step.line, done.what),
                    mesh.points.size(), mesh.cells.size(), watch.lap(),
                    done.changes_mesh ? was : "");
        for (const std::string& remark : done.remarks) {
            note(wrong_line(script, step, remark).what());
        }
    }
}

}  // namespace

void adapt_by_reference(const AdaptationOptions& options, const Script& script) {
    refuse_what_the_reference_lacks(options, script);
    check_files(options, script, {}, 1);
    check_lists_of(script);
    Stopwatch watch;
    AdaptedByReference adapted(read_input(options.input), options.max_cells);
    check_regions_of(script, adapted.mesh().regions, ProcessGroup::alone());
    const Run run{&options, distributed::Communicator(), &watch};
    const auto size = [&]() -> MeshSize {
        return {adapted.mesh().points.size(), adapted.mesh().cells.size()};
    };
    report_input(run, size(), [&] { return verify::distribute_slices(adapted.mesh(), run.world); });
    run_steps(adapted, script, options.quiet, watch);
    report_written(run, adapted.write(options.output), size());
}

}  // namespace octetra::cli
