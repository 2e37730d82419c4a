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
#include "commands/commands.hpp"
#include "commands/distinct_files.hpp"
#include "commands/input_check.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/profile_options.hpp"
#include "commands/refine/judge.hpp"
#include "commands/refine/options.hpp"
#include "commands/refine/report.hpp"
#include "commands/refinement_options.hpp"
#include "commands/report_line.hpp"
#include "negative_answer.hpp"
#include "stopwatch.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

Plan plan_of(const RefineOptions& options) {
    return {.selection = parse_selection(options.refinement.selection),
            .scheme = parse_scheme(options.refinement),
            .closure = parse_closure(options.refinement),
            .engine = parse_engine(options.engine, options.parallel),
            .partition = partition_of(options.parallel),
            .synchronisation = synchronisation_of(options.parallel),
            .balance = balance_of(options.parallel)};
}

/// Runs an engine, and prepends the name of the mesh to its errors.
auto with_mesh_name(const RefineOptions& options, auto&& engine) {
    try {
        return engine();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", options.input.path, error.what()));
    }
}

/// Returns the number of cells that exceed the maximum volume of the selection, or 0 without one.
std::uint64_t too_large_cells(const IndexVector<VertexIndex, Point>& points,
                              const IndexVector<CellIndex, CellVertices>& cells,
                              const Selection& selection) {
    if (!selection.max_volume) return 0;
    const Selection too_large{.max_volume = selection.max_volume};
    return static_cast<std::uint64_t>(std::ranges::count_if(cells, [&](const CellVertices& cell) {
        const auto& [a, b, c, d] = cell;
        return marks(too_large, {points[a], points[b], points[c], points[d]}, Marker{0},
                     GlobalCell{0});
    }));
}

/// Collective. Verifies, if requested, and writes a mesh held by the first process. Returns false
/// on all processes if it is not valid.
bool judge_and_write(const Mesh& coarse, const Mesh& fine, const RefinementMaps& maps,
                     const Plan& plan, const RefineOptions& options,
                     const distributed::Communicator& world, Stopwatch& watch) {
    std::vector<char> valid{1};
    world.on_first([&] {
        WholeMesh source(fine, &maps);
        if (options.verify) {
            const distributed::Phase phase(world, "verify");
            valid.front() = is_valid(coarse, fine, maps, plan, options) ? 1 : 0;
            if (valid.front() == 0) return;
            report(options, "verified", fine.points.size(), fine.cells.size(), watch.lap());
        }
        const distributed::Phase phase(world, "write");
        const std::string lost = write_mesh(source, options.output);
        report_written(options, lost, source.facts(), watch.lap());
        if (!options.maps.empty()) write_maps(source, options.maps);
    });
    world.broadcast(valid);
    return valid.front() == 1;
}

/// Collective. Completes the selection of the plan with the facts of the mesh.
void complete_plan(Plan& plan, const MeshFacts& facts, const RefineOptions& options,
                   const distributed::Communicator& world) {
    complete_selection(plan.selection, options.refinement.selection,
                       {facts.index_base, facts.cells, facts.group_names}, world);
}

/// Collective; the first process works while others wait. Returns false if the result is not valid.
bool refine_by_reference(Plan plan, const RefineOptions& options,
                         const distributed::Communicator& world, Stopwatch& watch) {
    Mesh mesh;
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] {
            mesh = read_input(options.input);
            check_regions(options.refinement.selection, mesh.regions, ProcessGroup::alone());
        });
        complete_plan(plan, WholeMesh(mesh).facts(), options, world);
    });
    const auto report_mesh = [&](const char* done) {
        if (!world.is_first()) return;
        report(options, fmt::format("{} {}", done, options.input.path), mesh.points.size(),
               mesh.cells.size(), watch.lap());
    };
    report_mesh("read");
    if (options.check) {
        check_input(mesh, options.input.path, world);
        report_mesh("checked");
    }
    reference::Refinement fine;
    world.on_first([&] {
        const distributed::Phase phase(world, "refine");
        const int levels = options.refinement.levels;
        fine = with_mesh_name(options, [&] {
            return plan.closure == Closure::regular
                       ? reference::refine_regularly(mesh, plan.selection, levels,
                                                     options.max_cells)
                       : reference::refine(mesh, plan.selection, plan.scheme, levels,
                                           options.max_cells);
        });
        const bool idle = fine.mesh.cells.size() == mesh.cells.size();
        report_refined(
            options,
            {.levels = idle ? 0 : levels,
             .facts = WholeMesh(fine.mesh, &fine.maps).facts(),
             .too_large = too_large_cells(fine.mesh.points, fine.mesh.cells, plan.selection)},
            watch.lap());
    });
    return judge_and_write(mesh, fine.mesh, fine.maps, plan, options, world, watch);
}

/// Collective. Reads the mesh into parts, weighted by the planned refinement.
distributed::DistributedMesh read_in_parts(Plan& plan, const RefineOptions& options,
                                           const distributed::Communicator& world) {
    const auto complete = [&](const MeshFacts& facts) {
        complete_plan(plan, facts, options, world);
    };
    const auto weigh = [&](const distributed::CellsToWeigh& cells) {
        return distributed::predicted_cells(cells, plan.selection, plan.scheme,
                                            options.refinement.levels);
    };
    return distributed::read_parts(
        world, options.input.path, plan.partition,
        {.read = read_options(options.input), .on_facts = complete, .weigh = weigh});
}

/// Collective. Returns false on all processes if the result is not valid.
bool refine_distributed(Plan plan, const RefineOptions& options,
                        const distributed::Communicator& world, Stopwatch& watch) {
    auto parts = read_in_parts(plan, options, world);
    check_regions(options.refinement.selection, parts.cell_ancestors.markers, world);
    const auto report_mesh = [&](const char* done) {
        if (!world.is_first()) return;
        report(options, fmt::format("{} {}", done, options.input.path), parts.input_vertex_count,
               parts.input_cell_count, watch.lap());
    };
    report_mesh("read");
    if (options.check) {
        check_input(parts, options.input.path);
        report_mesh("checked");
    }
    const bool verify_alone = options.verify && world.size() == 1;
    const bool verify_together = options.verify && world.size() > 1;
    const Mesh coarse = verify_alone ? distributed::collect_copy(parts).mesh : Mesh{};
    verify::MeshSlice coarse_slice;
    if (verify_together) {
        distributed::in_phase(world, "verify", [&] { coarse_slice = slice_of(parts); });
    }
    int levels = 0;
    const auto show = level_progress(options.quiet, options.refinement.levels);
    const auto on_level = [&](int level, std::uint64_t cells) {
        levels = level;
        if (show) show(level, cells);
    };
    std::uint64_t too_large = 0;
    const auto report_parts = [&](const MeshFacts& facts) {
        if (!world.is_first()) return;
        if (show) clear_level_progress();
        report_refined(options, {levels, world.size(), facts, too_large}, watch.lap());
    };
    if (plan.balance) {
        // The origin of cells is needed only in these cases.
        plan.balance->may_forget_history = options.maps.empty() && !options.verify &&
                                           plan.selection.cells.empty() &&
                                           !records_origins(options.output);
    }
    with_mesh_name(options, [&] {
        distributed::refine(parts, plan.selection,
                            {.scheme = plan.scheme,
                             .levels = options.refinement.levels,
                             .synchronisation = plan.synchronisation,
                             .max_cells = options.max_cells,
                             .is_last = true,
                             .balance = plan.balance,
                             .on_level = on_level});
    });
    if (plan.selection.max_volume) {
        const distributed::Phase phase(world, "select");
        too_large = world.sum(too_large_cells(parts.points, parts.cells, plan.selection));
    }
    if (verify_alone) {
        const auto fine =
            with_mesh_name(options, [&] { return distributed::collect(std::move(parts)); });
        report_parts(WholeMesh(fine.mesh, &fine.maps).facts());
        return judge_and_write(coarse, fine.mesh, fine.maps, plan, options, world, watch);
    }
    auto fine =
        with_mesh_name(options, [&] { return distributed::CanonicalMesh(std::move(parts)); });
    report_parts(fine.facts());
    if (verify_together) {
        const distributed::Phase phase(world, "verify");
        if (!is_valid_distributed(std::move(coarse_slice), fine, plan, options, world))
            return false;
        if (world.is_first()) {
            report(options, "verified", fine.facts().vertices, fine.facts().cells, watch.lap());
        }
    }
    const distributed::Phase phase(world, "write");
    const std::string lost = distributed::write_mesh(fine, options.output);
    if (world.is_first()) report_written(options, lost, fine.facts(), watch.lap());
    if (!options.maps.empty()) write_maps(fine.whole(), options.maps);
    return true;
}

/// Throws InputError for outputs that cannot be written, or that would overwrite an input or each
/// other.
void check_outputs(const RefineOptions& options, const Plan& plan, int ranks) {
    check_writable(options.output, ranks);
    const std::vector<NamedFiles> beside{file_named("--maps", options.maps),
                                         file_named("--profile", options.profile.profile),
                                         file_named("--trace", options.profile.trace)};
    for (const auto& [option, files] : beside) {
        for (const std::filesystem::path& file : files) check_side_file(option, file);
    }
    check_distinct_files(
        {mesh_named("MESH", options.input.path),
         file_named("--cells", options.refinement.selection.cells_file),
         file_named("--partition", plan.partition.path)},
        {mesh_to_write("-o", options.output, ranks), beside[0], beside[1], beside[2]});
}

/// Refines a mesh with history or fields or with the regular closure, or writes a history: runs as
/// a step of octetra adapt.
void refine_with_history(const RefineOptions& options, const Plan& plan,
                         const distributed::Communicator& all) {
    if (plan.engine == Engine::reference) {
        const bool has_fields = !options.input.fields.empty();
        throw InputError(fmt::format(
            "--engine reference does not support {} and cannot be combined with {}: omit "
            "it; the default engine makes the same mesh",
            has_fields ? "fields" : "history", has_fields ? "--fields" : ".octetra files"));
    }
    const Script one_step{
        {},
        false,
        {{0, "refine", RefineStep{options.refinement, plan.selection, plan.scheme, plan.closure}}}};
    adapt({.input = options.input,
           .output = options.output,
           .parallel = options.parallel,
           .profile = options.profile,
           .max_cells = options.max_cells,
           .maps = options.maps,
           .check = options.check,
           .verify = options.verify,
           // With the regular closure, the cells of OUT need not be pieces of those of MESH.
           .claim = plan.closure == Closure::regular ? Claim::refines_input : Claim::refines_mesh,
           .quiet = options.quiet},
          one_step, measured(all, options.profile));
}

void refine(const RefineOptions& options, const distributed::Communicator& all) {
    Plan plan = plan_of(options);
    const bool is_regular = plan.closure == Closure::regular && plan.engine == Engine::distributed;
    if (is_regular || is_checkpoint(options.input.path) || is_checkpoint(options.output) ||
        !options.input.fields.empty()) {
        return refine_with_history(options, plan, all);
    }
    Stopwatch watch;
    const distributed::Communicator world = measured(all, options.profile);
    distributed::in_phase(world, "read", [&] {
        world.on_first([&] { check_outputs(options, plan, world.size()); });
    });
    const bool done = plan.engine == Engine::reference
                          ? refine_by_reference(plan, options, world, watch)
                          : refine_distributed(plan, options, world, watch);
    write_profile(world, options.profile, options.quiet);
    if (!done) throw NegativeAnswer{};
}

void add_engine_options(CLI::App& command, RefineOptions& options) {
    const std::string group = "Execution (does not change the result)";
    add_engine_option(command, options.engine, group);
    add_partition_option(command, options.parallel, group);
    add_synchronisation_option(command, options.parallel, group);
    add_rebalance_option(command, options.parallel, group);
}

}  // namespace

void add_refine(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<RefineOptions>();
    CLI::App* refine_command =
        program.add_subcommand("refine",
                               "Refine a mesh in marked cells, and around them as far as "
                               "conformity requires");
    add_input_options(*refine_command, options->input);
    add_fields_option(*refine_command, options->input);
    add_output_option(*refine_command, options->output);
    add_refinement_options(*refine_command, options->refinement,
                           "Cells to refine (criteria are combined; at least one is required)");
    add_closure_option(*refine_command, options->refinement);
    add_number(*refine_command, "--max-cells", options->max_cells, whole_numbers_from(1),
               "fail, without writing, before a level that would exceed N cells")
        ->type_name("N");
    add_engine_options(*refine_command, *options);
    refine_command
        ->add_option("--maps", options->maps,
                     "also write the parent of each cell and the edge of each midpoint, as text")
        ->type_name("FILE")
        ->check(file_name_validator());
    add_profile_options(*refine_command, options->profile);
    refine_command->add_flag("--check", options->check,
                             "verify MESH (as octetra verify), and refine it only if it is valid");
    refine_command->add_flag(
        "--verify", options->verify,
        "verify the result (as octetra verify), and write it only if it is valid");
    refine_command->add_flag("--quiet", options->quiet, "print only notes and errors");
    refine_command->footer(
        "Exit status: 0 done; 1 --verify finds the result not valid, and nothing is written;\n"
        "2 bad usage or bad input; 3 the system failed: memory, disk; 128 + its number: a signal\n"
        "ended a rank, for example 137 if it was killed.\n"
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu\n"
        "  mpirun -n 4 octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu");
    refine_command->callback([options, world] { refine(*options, world); });
}

}  // namespace octetra::cli
