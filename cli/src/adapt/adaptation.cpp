#include "adapt/adaptation.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/series.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/read_parts.hpp>
#include <octetra/verify/verify.hpp>

#include "adapt/check_files.hpp"
#include "adapt/judge.hpp"
#include "adapt/maps_since.hpp"
#include "adapt/predicted_by_steps.hpp"
#include "adapt/run.hpp"
#include "adapt/run_script.hpp"
#include "adapt/size_files.hpp"
#include "adapt/step_texts.hpp"
#include "adapt/transfer_fields.hpp"
#include "adapt/write_result.hpp"
#include "commands/mesh_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "negative_answer.hpp"
#include "script/check_script.hpp"
#include "script/read_script.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

/// Collective. Writes the series of meshes, if requested: the input and the result of each step.
/// Steps are counted from 1.
class Series {
public:
    Series(const std::string& path, const distributed::Communicator& world) {
        if (!path.empty()) file_.emplace(path, world);
    }
    void append(const distributed::AdaptiveMesh& mesh, std::span<const distributed::Field> fields) {
        if (!file_) return;
        const distributed::Phase phase(mesh.processes(), "write");
        mesh.append_to(*file_, steps_++, fields);
    }
    void commit(const distributed::Communicator& world) {
        if (!file_) return;
        const distributed::Phase phase(world, "write");
        const std::string lost = file_->commit();
        if (world.is_first() && !lost.empty()) note(lost);
    }

private:
    std::optional<MeshSeries> file_;
    int steps_ = 0;
};

/// Collective.
MeshSize size_of(const distributed::AdaptiveMesh& mesh) {
    return {mesh.vertex_count(), mesh.processes().sum(mesh.cells().size())};
}

/// Collective. Loads a checkpoint, partitioned by rcb unless another method is given, so that no
/// process holds the whole input.
distributed::AdaptiveMesh load(const AdaptationOptions& options,
                               const distributed::Communicator& world,
                               std::vector<distributed::Field>& fields) {
    const distributed::Partition rcb{.method = distributed::PartitionMethod::rcb};
    const bool is_given = options.parallel.partition.has_value();
    return distributed::AdaptiveMesh::load(
        world, options.input.path, is_given ? partition_of(options.parallel) : rcb, &fields);
}

/// Collective. Returns the facts of a checkpoint before it is loaded, on the first process.
MeshFacts facts_of_checkpoint(const std::string& path, const distributed::Communicator& world) {
    const distributed::Phase phase(world, "read");
    MeshFacts read;
    world.on_first([&] {
        const CheckpointFacts facts = read_checkpoint_facts(path);
        read = {.vertices = facts.vertices_now,
                .cells = facts.cells_now,
                .index_base = facts.index_base,
                .group_names = SharedGroupNames(facts.group_names)};
        if (facts.state) note(state_is_lost(path));
    });
    return read;
}

/// Collective. Reads MESH into parts, weighted by the steps of the script. Sets `read` to its facts
/// on the first process.
distributed::AdaptiveMesh read_in_parts(const AdaptationOptions& options, const Script& script,
                                        const distributed::Partition& partition,
                                        const distributed::Communicator& world, MeshFacts& read) {
    const auto weigh = [&](const distributed::CellsToWeigh& cells) {
        return predicted_by_steps(cells, script);
    };
    return distributed::AdaptiveMesh(
        distributed::read_parts(world, options.input.path, partition,
                                {.read = read_options(options.input),
                                 .on_facts = [&](const MeshFacts& facts) { read = facts; },
                                 .weigh = weigh}));
}

/// Collective. Returns the mesh of which the result is to be a refinement: the input of the
/// history, or the mesh; nothing if it is to be a coarsening.
verify::MeshSlice slice_to_judge(const distributed::AdaptiveMesh& mesh,
                                 const AdaptationOptions& options) {
    if (options.claim == Claim::coarsens_mesh) return {};
    if (options.claim == Claim::refines_mesh || !is_checkpoint(options.input.path)) {
        return slice_of(mesh);
    }
    Mesh input;
    mesh.processes().on_first([&] { input = read_checkpoint(options.input.path).input; });
    return verify::distribute_slices(input, mesh.processes());
}

/// Collective. Returns the request of the only step, for the mesh as it was read.
verify::Request request_of(RefineStep step, const MeshFacts& read,
                           const distributed::Communicator& world) {
    complete_selection(step.selection, step.typed.selection,
                       {read.index_base, read.cells, read.group_names}, world);
    return {step.selection, step.scheme, step.typed.levels};
}

bool is_regular_step(const ScriptStep& step) { return closure_of(step.step) == Closure::regular; }

bool has_regular_step(const Script& script) {
    return std::ranges::any_of(script.steps, is_regular_step);
}

/// Returns the closure of all steps that refine; that of longest edges if they differ, as they can
/// if the mesh was coarsened to the input.
Closure common_closure(const Script& script) {
    const bool are_all = std::ranges::all_of(script.steps, [](const ScriptStep& step) {
        return !closure_of(step.step) || is_regular_step(step);
    });
    return are_all && has_regular_step(script) ? Closure::regular : Closure::longest_edge;
}

/// Returns whether a step uses the history of the mesh.
bool uses_history(const Script& script) {
    return std::ranges::any_of(script.steps, [](const ScriptStep& step) {
        const auto* const refine = std::get_if<RefineStep>(&step.step);
        const auto* const coarsen = std::get_if<CoarsenStep>(&step.step);
        return std::holds_alternative<FitStep>(step.step) ||
               (refine != nullptr && octetra::uses_history(refine->selection)) ||
               (coarsen != nullptr && octetra::uses_history(coarsen->selection));
    });
}

/// Collective. Returns whether the result satisfies the claim.
bool is_valid(const Run& run, const distributed::AdaptiveMesh& mesh, verify::MeshSlice coarse,
              const Script& script, const MeshFacts& read, const std::optional<CellsSince>& since) {
    const AdaptationOptions& options = *run.options;
    if (options.claim == Claim::coarsens_mesh) {
        const auto& step = std::get<CoarsenStep>(script.steps.front().step);
        return is_valid_coarsening(run, mesh, {options.input.path, step.typed, step.selection});
    }
    const distributed::Phase phase(run.world, "verify");
    std::optional<MapsSince> maps;
    if (since) maps.emplace(mesh, *since);
    Judgement judgement{.closure = common_closure(script), .maps = maps ? &*maps : nullptr};
    if (options.claim == Claim::refines_mesh) {
        const auto& step = std::get<RefineStep>(script.steps.front().step);
        const bool is_reduced = step.typed.target_cells.has_value();
        if (is_reduced && run.world.is_first()) {
            note("--verify checks a refinement of any cells: --target-cells omits marked cells");
        }
        if (!is_reduced) note_unverified(run, step.selection);
        if (!is_reduced && can_verify(step.selection))
            judgement.request = request_of(step, read, run.world);
    }
    return is_valid_refinement(run, std::move(coarse), slice_of(mesh), judgement);
}

}  // namespace

void adapt(const AdaptationOptions& options, const Script& script,
           const distributed::Communicator& world) {
    const distributed::Partition partition = partition_of(options.parallel);
    const distributed::StepOptions steps{.synchronisation = synchronisation_of(options.parallel),
                                         .max_cells = options.max_cells};
    Stopwatch watch;
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] {
            check_files(options, script, partition, world.size());
            check_lists_of(script);
        });
    });
    MeshFacts read;  // on the first process
    CarriedFields fields;
    const bool has_history = is_checkpoint(options.input.path);
    if (has_history && !options.maps.empty() && has_regular_step(script)) {
        throw InputError(
            "--maps: with the regular closure, vertices of a mesh with a history do not keep their "
            "numbers; maps can be written from a mesh without history");
    }
    if (has_history) read = facts_of_checkpoint(options.input.path, world);
    auto adaptive =
        has_history
            ? distributed::in_phase(world, "read", [&] { return load(options, world, fields.all); })
            : read_in_parts(options, script, partition, world, read);
    check_regions_of(script, adaptive.regions(), world);
    distributed::in_phase(world, "read", [&] {
        read_fields(adaptive, options.input, fields.all);
        read_size_files(adaptive, script, fields);
    });
    const Run run{&options, world, &watch};
    report_input(run, size_of(adaptive), [&] { return slice_of(adaptive); });
    verify::MeshSlice coarse;
    if (options.verify) coarse = slice_to_judge(adaptive, options);
    std::optional<CellsSince> since;
    if (!options.maps.empty()) since.emplace(adaptive);
    const auto follow = [&](const distributed::Adaptation& step) {
        if (since) since->follow(step);
        for (const std::string& dropped : transfer_fields(fields.all, step, world)) {
            if (world.is_first()) note(dropped);
        }
    };
    const auto move_along = [&](const distributed::Migration& move) {
        if (since) since->follow(move);
        transfer_fields(fields.all, move);
    };
    Series series(options.series, world);
    series.append(adaptive, fields.written());
    const bool tells_origin = since.has_value() || records_origins(options.output);
    run_script(adaptive, script,
               {.input = read,
                .has_steps = has_history,
                .options = steps,
                .balance = balance_of(options.parallel),
                .may_forget_history = options.series.empty() && !uses_history(script),
                .recalls_history = tells_origin,
                .on_step = follow,
                .on_move = move_along,
                .on_changed = [&] { series.append(adaptive, fields.written()); },
                .fields = &fields,
                .quiet = options.quiet},
               watch);
    if (options.verify) {
        if (!is_valid(run, adaptive, std::move(coarse), script, read, since)) {
            write_profile(world, options.profile, options.quiet);
            throw NegativeAnswer{};
        }
        report(run, "verified", size_of(adaptive));
    }
    const std::string lost = write_result(adaptive, fields.written(), options.output);
    report_written(run, lost, size_of(adaptive));
    if (has_regular_step(script) && !is_checkpoint(options.output) && world.is_first()) {
        note(std::string(regular_history_is_lost));
    }
    series.commit(world);
    if (since) {
        const distributed::Phase phase(world, "write");
        MapsSince source(adaptive, *since);
        write_maps(source, options.maps);
    }
    write_profile(world, options.profile, options.quiet);
}

}  // namespace octetra::cli
