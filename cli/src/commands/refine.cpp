#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/read_parts.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "adapt/adaptation.hpp"
#include "adapt/check_files.hpp"
#include "adapt/judge.hpp"
#include "adapt/run.hpp"
#include "adapt/size_files.hpp"
#include "adapt/step_texts.hpp"
#include "commands/commands.hpp"
#include "commands/engine_option.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "commands/refinement_options.hpp"
#include "commands/report_line.hpp"
#include "grouped.hpp"
#include "negative_answer.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

/// The options of octetra refine, as given.
struct RefineOptions {
    RefinementOptions refinement;
    std::string engine = "distributed";
    AdaptationOptions adaptation;
};

/// The validated and parsed options.
struct Plan {
    RefineStep step;
    Engine engine = Engine::distributed;
    distributed::Partition partition;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    std::optional<distributed::BalanceOptions> balance;
};

Plan plan_of(const RefineOptions& options) {
    const ParallelOptions& parallel = options.adaptation.parallel;
    return {.step = {options.refinement, parse_selection(options.refinement.selection),
                     parse_scheme(options.refinement), parse_closure(options.refinement)},
            .engine = parse_engine(options.engine, parallel),
            .partition = partition_of(parallel),
            .synchronisation = synchronisation_of(parallel),
            .balance = balance_of(parallel)};
}

/// Runs an engine, and prepends the name of the mesh to its errors.
auto with_mesh_name(const Run& run, auto&& engine) {
    try {
        return engine();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", run.options->input.path, error.what()));
    }
}

/// Returns the number of cells that exceed the maximum volume of the selection, or 0 without one.
std::uint64_t too_large_cells(const IndexVector<VertexIndex, Point>& points,
                              const IndexVector<CellIndex, CellVertices>& cells,
                              const Selection& selection) {
    if (!selection.max_volume || !selection.narrowed_by.empty()) return 0;
    const Selection too_large{.max_volume = selection.max_volume};
    return static_cast<std::uint64_t>(std::ranges::count_if(cells, [&](const CellVertices& cell) {
        const auto& [a, b, c, d] = cell;
        return marks(too_large, {points[a], points[b], points[c], points[d]}, Marker{0},
                     GlobalCell{0});
    }));
}

/// Collective. Completes the selection with the facts of the mesh.
void complete_step(RefineStep& step, const MeshFacts& facts,
                   const distributed::Communicator& world) {
    complete_selection(step.selection, step.typed.selection,
                       {facts.index_base, facts.cells, facts.group_names}, world);
}

/// Reports that `levels` levels changed the mesh. `too_large`: the number of cells that exceed the
/// maximum volume.
void report_refined(const Run& run, const RefineStep& step, int levels, int ranks,
                    const MeshSize& size, std::uint64_t too_large) {
    const std::string done = levels_done("refined", levels);
    report(run, ranks == 1 ? done : fmt::format("{}, {} ranks", done, ranks), size);
    if (!run.world.is_first()) return;
    for (const std::string& remark :
         idle_levels(levels, step.typed.levels, idle_refinement_reason)) {
        note(remark);
    }
    if (too_large == 0) return;
    note(fmt::format("{} cell{} larger than --max-volume after {} level{}: more --levels may help",
                     grouped(too_large), too_large == 1 ? " is" : "s are", levels,
                     levels == 1 ? "" : "s"));
}

/// Collective. Returns whether the result of the step is valid, and reports it.
bool is_valid(const Run& run, const RefineStep& step, verify::MeshSlice coarse, MeshSource& fine,
              bool has_maps) {
    Judgement judgement{
        .closure = step.closure, .maps = has_maps ? &fine : nullptr, .is_only_output = true};
    note_unverified(run, step.selection);
    if (can_verify(step.selection)) {
        judgement.request = {step.selection, step.scheme, step.typed.levels};
    }
    if (!is_valid_refinement(run, std::move(coarse), verify::slice_of(fine), judgement)) {
        return false;
    }
    report(run, "verified", size_of(fine.facts()));
    return true;
}

reference::Refinement refined_by_reference(const Mesh& mesh, const RefineStep& step,
                                           std::uint64_t max_cells) {
    const int levels = step.typed.levels;
    if (step.closure == Closure::regular) {
        return reference::refine_regularly(mesh, step.selection, levels, max_cells);
    }
    return reference::refine(mesh, step.selection, step.scheme, levels, max_cells);
}

/// Collective; the first process works while others wait. Returns false if the result is not valid.
bool refine_by_reference(RefineStep step, const Run& run) {
    const distributed::Communicator& world = run.world;
    const AdaptationOptions& options = *run.options;
    Mesh mesh;
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] {
            mesh = read_input(options.input);
            check_regions(step.typed.selection, mesh.regions, ProcessGroup::alone());
        });
        complete_step(step, WholeMesh(mesh).facts(), world);
    });
    report_input(run, size_of(WholeMesh(mesh).facts()),
                 [&] { return verify::distribute_slices(mesh, world); });
    bool valid = true;
    world.on_first([&] {
        const Run here{&options, distributed::Communicator(), run.watch};
        const reference::Refinement refined = distributed::in_phase(world, "refine", [&] {
            return with_mesh_name(
                run, [&] { return refined_by_reference(mesh, step, options.max_cells); });
        });
        const bool idle = refined.mesh.cells.size() == mesh.cells.size();
        WholeMesh fine(refined.mesh, &refined.maps);
        report_refined(here, step, idle ? 0 : step.typed.levels, 1, size_of(fine.facts()),
                       too_large_cells(refined.mesh.points, refined.mesh.cells, step.selection));
        if (options.verify) {
            const distributed::Phase phase(world, "verify");
            valid = is_valid(here, step, verify::distribute_slices(mesh, here.world), fine, true);
            if (!valid) return;
        }
        const distributed::Phase phase(world, "write");
        report_written(here, write_mesh(fine, options.output), size_of(fine.facts()));
        if (!options.maps.empty()) write_maps(fine, options.maps);
    });
    return world.of_first(std::uint64_t{valid ? 1U : 0U}) != 0;
}

/// Collective. Reads the mesh into parts, weighted by the planned refinement.
distributed::DistributedMesh read_in_parts(Plan& plan, const Run& run) {
    RefineStep& step = plan.step;
    const auto complete = [&](const MeshFacts& facts) { complete_step(step, facts, run.world); };
    const auto weigh = [&](const distributed::CellsToWeigh& cells) {
        return distributed::predicted_cells(cells, step.selection, step.scheme, step.typed.levels);
    };
    return distributed::read_parts(
        run.world, run.options->input.path, plan.partition,
        {.read = read_options(run.options->input), .on_facts = complete, .weigh = weigh});
}

/// Collective. Returns false on all processes if the result is not valid.
bool refine_distributed(Plan plan, const Run& run) {
    const distributed::Communicator& world = run.world;
    const AdaptationOptions& options = *run.options;
    auto parts = read_in_parts(plan, run);
    const RefineStep& step = plan.step;
    check_regions(step.typed.selection, parts.cell_ancestors.markers, world);
    report_input(run, {parts.input_vertex_count, parts.input_cell_count},
                 [&] { return slice_of(parts); });
    verify::MeshSlice coarse;
    if (options.verify) {
        coarse = distributed::in_phase(world, "verify", [&] { return slice_of(parts); });
    }
    int levels = 0;
    const auto show = level_progress(options.quiet, step.typed.levels);
    const auto on_level = [&](int level, std::uint64_t cells) {
        levels = level;
        if (show) show(level, cells);
    };
    if (plan.balance) {
        // The origin of cells is needed only in these cases.
        plan.balance->may_forget_history = options.maps.empty() && !options.verify &&
                                           step.selection.cells.empty() &&
                                           !records_origins(options.output);
    }
    with_mesh_name(run, [&] {
        distributed::refine(parts, step.selection,
                            {.scheme = step.scheme,
                             .levels = step.typed.levels,
                             .synchronisation = plan.synchronisation,
                             .max_cells = options.max_cells,
                             .is_last = true,
                             .balance = plan.balance,
                             .on_level = on_level});
    });
    std::uint64_t too_large = 0;
    if (step.selection.max_volume) {
        const distributed::Phase phase(world, "select");
        too_large = world.sum(too_large_cells(parts.points, parts.cells, step.selection));
    }
    auto fine = with_mesh_name(run, [&] { return distributed::CanonicalMesh(std::move(parts)); });
    const MeshSize size = size_of(fine.facts());
    if (show && world.is_first()) clear_level_progress();
    report_refined(run, step, levels, world.size(), size, too_large);
    if (options.verify) {
        const distributed::Phase phase(world, "verify");
        // One process has the maps anyway.
        const bool has_maps = world.size() == 1 || !options.maps.empty();
        if (!is_valid(run, step, std::move(coarse), fine.whole(), has_maps)) return false;
    }
    const distributed::Phase phase(world, "write");
    report_written(run, distributed::write_mesh(fine, options.output), size);
    if (!options.maps.empty()) write_maps(fine.whole(), options.maps);
    return true;
}

/// Refines a mesh with history or fields or with the regular closure, or writes a history: runs as
/// a step of octetra adapt.
void refine_with_history(const Plan& plan, const Script& one_step, AdaptationOptions options,
                         const distributed::Communicator& world) {
    if (plan.engine == Engine::reference) {
        if (plan.step.typed.target_cells) {
            throw InputError(
                "--target-cells cannot be combined with --engine reference: omit it; "
                "the default engine makes the same mesh as with a list of cells");
        }
        if (has_size_file(one_step)) throw InputError(std::string(reference_lacks_size_files));
        const bool has_fields = !options.input.fields.empty();
        throw InputError(fmt::format(
            "--engine reference does not support {} and cannot be combined with {}: omit "
            "it; the default engine makes the same mesh",
            has_fields ? "fields" : "history", has_fields ? "--fields" : ".octetra files"));
    }
    // With the regular closure, the cells of OUT need not be pieces of those of a mesh with
    // history.
    const bool replaces_cells =
        plan.step.closure == Closure::regular && is_checkpoint(options.input.path);
    options.claim = replaces_cells ? Claim::refines_input : Claim::refines_mesh;
    adapt(options, one_step, world);
}

void refine(const RefineOptions& given, const distributed::Communicator& all) {
    const AdaptationOptions& options = given.adaptation;
    const Plan plan = plan_of(given);
    const Script one_step{{}, false, {{0, "refine", plan.step}}};
    const bool is_reference = plan.engine == Engine::reference;
    const bool is_regular = plan.step.closure == Closure::regular && !is_reference;
    if (is_regular || is_checkpoint(options.input.path) || is_checkpoint(options.output) ||
        !options.input.fields.empty() || has_size_file(one_step) || plan.step.typed.target_cells) {
        return refine_with_history(plan, one_step, options, measured(all, options.profile));
    }
    Stopwatch watch;
    const Run run{&options, measured(all, options.profile), &watch};
    const distributed::Communicator& world = run.world;
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] { check_files(options, one_step, plan.partition, world.size()); });
    });
    const bool done =
        is_reference ? refine_by_reference(plan.step, run) : refine_distributed(plan, run);
    write_profile(world, options.profile, options.quiet);
    if (!done) throw NegativeAnswer{};
}

}  // namespace

void add_refine(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<RefineOptions>();
    CLI::App* refine_command =
        program.add_subcommand("refine",
                               "Refine a mesh in marked cells, and around them as far as "
                               "conformity requires");
    add_input_options(*refine_command, options->adaptation.input);
    add_fields_option(*refine_command, options->adaptation.input);
    add_output_option(*refine_command, options->adaptation.output);
    add_refinement_options(*refine_command, options->refinement,
                           "Cells to refine (criteria are combined; at least one is required)");
    add_closure_option(*refine_command, options->refinement);
    add_target_option(*refine_command, options->refinement);
    add_number(*refine_command, "--max-cells", options->adaptation.max_cells, whole_numbers_from(1),
               "fail, without writing, before a level that would exceed N cells")
        ->type_name("N");
    add_engine_options(*refine_command, options->engine, options->adaptation.parallel);
    refine_command
        ->add_option("--maps", options->adaptation.maps,
                     "also write the parent of each cell and the edge of each midpoint, as text")
        ->type_name("FILE")
        ->check(file_name_validator());
    add_profile_options(*refine_command, options->adaptation.profile);
    refine_command->add_flag("--check", options->adaptation.check,
                             "verify MESH (as octetra verify), and refine it only if it is valid");
    refine_command->add_flag(
        "--verify", options->adaptation.verify,
        "verify the result (as octetra verify), and write it only if it is valid");
    refine_command->add_flag("--quiet", options->adaptation.quiet, "print only notes and errors");
    refine_command->footer(
        "Exit status: 0 done; 1 --verify finds the result not valid, and nothing is written;\n"
        "2 bad usage or bad input; 3 the system failed: memory, disk; 128 + its number: a signal\n"
        "ended a rank, for example 137 if it was killed.\n"
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu\n"
        "  mpirun -n 4 octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu");
    refine_command->callback([options, refine_command, world] {
        complete_levels(*refine_command, options->refinement);
        group_criteria(*refine_command, options->refinement.selection);
        refine(*options, world);
    });
}

}  // namespace octetra::cli
