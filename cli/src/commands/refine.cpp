#include <unistd.h>
#include <algorithm>
#include <array>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/distributed/agreement.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>
#include <octetra/verify/verify.hpp>

#include "answer.hpp"
#include "choice.hpp"
#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/refinement_options.hpp"
#include "grouped.hpp"
#include "stopwatch.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

enum class Engine { distributed, reference };

constexpr std::array<Word<Engine>, 2> engines{
    {{"distributed", Engine::distributed}, {"reference", Engine::reference}}};
constexpr std::array<Word<distributed::Synchronisation>, 2> synchronisations{
    {{"neighbour", distributed::Synchronisation::neighbour},
     {"gateway", distributed::Synchronisation::gateway}}};

/// What the options mean, once they are known to mean something.
struct Plan {
    Selection selection;
    Scheme scheme = Scheme::eight;
    Engine engine = Engine::distributed;
    distributed::Partition partition;
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
};

struct RefineOptions {
    InputOptions input;
    std::string output;
    std::string maps;
    RefinementOptions refinement;
    std::string engine = "distributed";
    std::string partition = "lepp";
    std::string synchronisation = "neighbour";
    bool verify = false;
    bool quiet = false;
};

void report(const RefineOptions& options, std::string_view doing, const Mesh& mesh,
            double seconds) {
    if (options.quiet) return;
    fmt::print("{:<30} {:>13} vertices {:>13} cells {:>8.2f} s\n", doing,
               grouped(mesh.points.size()), grouped(mesh.cells.size()), seconds);
    std::fflush(stdout);
}

Plan plan_of(const RefineOptions& options) {
    return {.selection = parse_selection(options.refinement.selection),
            .scheme = parse_scheme(options.refinement),
            .engine = parse_choice("--engine", options.engine, engines),
            .partition = distributed::parse_partition(options.partition),
            .synchronisation = parse_choice("--sync", options.synchronisation, synchronisations)};
}

std::string refined_line(int levels, int ranks) {
    const std::string line = fmt::format("refined, {} level{}", levels, levels == 1 ? "" : "s");
    return ranks == 1 ? line : fmt::format("{}, {} ranks", line, ranks);
}

/// What an engine makes of a mesh; of several processes the first one has it.
struct Refined {
    Mesh mesh;
    RefinementMaps maps;
    int levels = 0;  ///< that changed something, as far as the engine tells
};

/// Runs an engine; what it finds wrong with the mesh gets the mesh's name in front.
auto naming_the_mesh(const RefineOptions& options, auto&& engine) {
    try {
        return engine();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", options.input.path, error.what()));
    }
}

Refined refine_by_reference(const Mesh& mesh, const Plan& plan, const RefineOptions& options,
                            const distributed::Communicator& world) {
    Refined fine;
    distributed::on_first(world, [&] {
        auto result = naming_the_mesh(options, [&] {
            return reference::refine(mesh, plan.selection, plan.scheme, options.refinement.levels);
        });
        fine = {std::move(result.mesh), std::move(result.maps), options.refinement.levels};
    });
    return fine;
}

/// Where people watch, a line that each level writes over.
std::function<void(int, std::uint64_t)> level_progress(const RefineOptions& options) {
    if (options.quiet || ::isatty(STDERR_FILENO) == 0) return {};
    return [levels = options.refinement.levels](int level, std::uint64_t cells) {
        fmt::print(stderr, "\rlevel {} of {}: {} cells ", level, levels, grouped(cells));
        std::fflush(stderr);
    };
}

Refined refine_distributed(Mesh mesh, const Plan& plan, const RefineOptions& options,
                           const distributed::Communicator& world) {
    std::vector<int> cell_to_rank;
    distributed::on_first(world, [&] {
        if (world.size() == 1) return;
        cell_to_rank = distributed::partition_cells(mesh, world.size(), plan.partition);
    });
    auto parts = distributed::distribute(world, std::move(mesh), cell_to_rank);
    int levels = 0;
    const auto show = level_progress(options);
    const auto on_level = [&](int level, std::uint64_t cells) {
        levels = level;
        if (show) show(level, cells);
    };
    auto whole = naming_the_mesh(options, [&] {
        distributed::refine(
            parts, plan.selection,
            {plan.scheme, options.refinement.levels, plan.synchronisation, on_level});
        return distributed::collect(std::move(parts));
    });
    if (show) fmt::print(stderr, "\r{:60}\r", "");
    return {std::move(whole.mesh), std::move(whole.maps), levels};
}

/// Says so where there was less to do than was asked for, or more is left than there may seem.
void note_idle_levels(const RefineOptions& options, int levels) {
    if (levels == options.refinement.levels) return;
    note(levels == 0 ? std::string("no cell was chosen: the mesh stays as it is")
                     : fmt::format("no cell was chosen any more after level {} of {}", levels,
                                   options.refinement.levels));
}

/// Judges what an engine has made. If it is not valid, says why.
bool is_valid(const Mesh& coarse, const Refined& fine, const Plan& plan,
              const RefineOptions& options) {
    constexpr std::size_t described_of_each_code = 100;
    const auto verdict = verify::verify_refinement(
        coarse, fine.mesh,
        {.request = verify::Request{plan.selection, plan.scheme, options.refinement.levels},
         .maps = &fine.maps,
         .kept_per_code = described_of_each_code});
    if (verdict.valid()) return true;
    print_verdict(
        verdict, {options.output, options.input.path, fine.mesh.first_number, coarse.first_number});
    fmt::print("nothing was written\n");
    return false;
}

void write_result(const Refined& fine, const RefineOptions& options) {
    write_output(fine.mesh, options.output, {.cell_to_parent = &fine.maps.cell_to_parent});
    if (!options.maps.empty()) write_maps(fine.maps, options.maps);
}

void refine(const RefineOptions& options, const distributed::Communicator& world) {
    Plan plan = plan_of(options);
    Stopwatch watch;
    Mesh mesh;
    Mesh coarse;  // the first process's, if it is to judge
    distributed::on_first(world, [&] {
        check_writable(options.output);
        if (!options.maps.empty()) check_side_file("--maps", options.maps);
        mesh = read_input(options.input);
        complete_selection(plan.selection, options.refinement.selection, mesh);
        report(options, fmt::format("read {}", options.input.path), mesh, watch.lap());
        if (options.verify) coarse = mesh;
    });
    world.broadcast(plan.selection.cells);

    const bool by_reference = plan.engine == Engine::reference;
    const std::size_t cells_before = mesh.cells.size();
    Refined fine = by_reference ? refine_by_reference(mesh, plan, options, world)
                                : refine_distributed(std::move(mesh), plan, options, world);
    std::vector<char> valid{1};
    distributed::on_first(world, [&] {
        if (fine.mesh.cells.size() == cells_before) fine.levels = 0;
        report(options, refined_line(fine.levels, by_reference ? 1 : world.size()), fine.mesh,
               watch.lap());
        note_idle_levels(options, fine.levels);
        if (options.verify) {
            valid.front() = is_valid(coarse, fine, plan, options) ? 1 : 0;
            if (valid.front() == 0) return;
            report(options, "verified", fine.mesh, watch.lap());
        }
        write_result(fine, options);
        report(options, fmt::format("wrote {}", options.output), fine.mesh, watch.lap());
    });
    world.broadcast(valid);
    if (valid.front() == 0) throw AnswerIsNo{};
}

void add_engine_options(CLI::App& command, RefineOptions& options) {
    const std::string group = "How it is done (the result is the same bytes)";
    command
        .add_option("--engine", options.engine,
                    "the fast one, over MPI under mpirun, or the serial reference [distributed]")
        ->type_name("distributed|reference")
        ->group(group);
    command
        .add_option("--partition", options.partition,
                    "which rank gets which cell: lepp, dual, block, random:SEED, file:PATH [lepp]")
        ->type_name("METHOD")
        ->group(group);
    command
        .add_option("--sync", options.synchronisation,
                    "ranks tell their neighbours, or the first rank, which tells the others "
                    "[neighbour]")
        ->type_name("neighbour|gateway")
        ->group(group);
}

}  // namespace

void add_refine(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<RefineOptions>();
    CLI::App* refine_command =
        program.add_subcommand("refine",
                               "Refine a mesh where you choose, and as far around as "
                               "conformity asks");
    add_input_options(*refine_command, options->input);
    add_output_option(*refine_command, options->output);
    add_refinement_options(*refine_command, options->refinement,
                           "Which cells (criteria add up; give at least one)");
    add_engine_options(*refine_command, *options);
    refine_command
        ->add_option("--maps", options->maps,
                     "also write each cell's parent and each midpoint's edge, as text")
        ->type_name("FILE");
    refine_command->add_flag(
        "--verify", options->verify,
        "judge the result as octetra verify does, and write it if it is valid");
    refine_command->add_flag("--quiet", options->quiet, "print nothing but notes and errors");
    refine_command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu\n"
        "  mpirun -n 4 octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu");
    refine_command->callback([options, world] { refine(*options, world); });
}

}  // namespace octetra::cli
