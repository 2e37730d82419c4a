#include <unistd.h>
#include <algorithm>
#include <array>

#include <cstdio>
#include <filesystem>
#include <map>
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

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/selection_options.hpp"
#include "grouped.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

enum class Engine { distributed, reference };

struct RefineOptions {
    InputOptions input;
    std::string output;
    std::string maps;
    SelectionOptions selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
    Engine engine = Engine::distributed;
    std::string partition = "lepp";
    distributed::Synchronisation synchronisation = distributed::Synchronisation::neighbour;
    bool quiet = false;
};

void report(const RefineOptions& options, std::string_view doing, const Mesh& mesh,
            double seconds) {
    if (options.quiet) return;
    fmt::print("{:<30} {:>13} vertices {:>13} cells {:>8.2f} s\n", doing,
               grouped(mesh.points.size()), grouped(mesh.cells.size()), seconds);
    std::fflush(stdout);
}

std::string refined_line(const RefineOptions& options, const distributed::Communicator& world) {
    const std::string levels =
        fmt::format("refined, {} level{}", options.levels, options.levels == 1 ? "" : "s");
    const bool alone = world.size() == 1 || options.engine == Engine::reference;
    return alone ? levels : fmt::format("{}, {} ranks", levels, world.size());
}

/// What an engine makes of a mesh; of several processes the first one has it.
struct Refined {
    Mesh mesh;
    RefinementMaps maps;
};

/// Runs an engine; what it finds wrong with the mesh gets the mesh's name in front.
auto naming_the_mesh(const RefineOptions& options, auto&& engine) {
    try {
        return engine();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", options.input.path, error.what()));
    }
}

Refined refine_by_reference(const Mesh& mesh, const Selection& selection,
                            const RefineOptions& options, const distributed::Communicator& world) {
    Refined fine;
    distributed::on_first(world, [&] {
        auto result = naming_the_mesh(options, [&] {
            return reference::refine(mesh, selection, options.scheme, options.levels);
        });
        fine = {std::move(result.mesh), std::move(result.maps)};
    });
    return fine;
}

/// Where people watch, a line that each level writes over.
std::function<void(int, std::uint64_t)> level_progress(const RefineOptions& options) {
    if (options.quiet || ::isatty(STDERR_FILENO) == 0) return {};
    return [levels = options.levels](int level, std::uint64_t cells) {
        fmt::print(stderr, "\rlevel {} of {}: {} cells ", level, levels, grouped(cells));
        std::fflush(stderr);
    };
}

Refined refine_distributed(Mesh mesh, const Selection& selection, const RefineOptions& options,
                           const distributed::Partition& partition,
                           const distributed::Communicator& world) {
    std::vector<int> cell_to_rank;
    distributed::on_first(world, [&] {
        if (world.size() == 1) return;
        cell_to_rank = distributed::partition_cells(mesh, world.size(), partition);
    });
    auto parts = distributed::distribute(world, std::move(mesh), cell_to_rank);
    const auto progress = level_progress(options);
    auto whole = naming_the_mesh(options, [&] {
        distributed::refine(parts, selection,
                            {options.scheme, options.levels, options.synchronisation, progress});
        return distributed::collect(std::move(parts));
    });
    if (progress) fmt::print(stderr, "\r{:60}\r", "");
    return {std::move(whole.mesh), std::move(whole.maps)};
}

void refine(const RefineOptions& options, const distributed::Communicator& world) {
    Selection selection = parse_selection(options.selection);
    const auto partition = distributed::parse_partition(options.partition);
    Stopwatch watch;
    Mesh mesh;
    distributed::on_first(world, [&] {
        check_writable(options.output);
        if (!options.maps.empty()) check_side_file("--maps", options.maps);
        mesh = read_input(options.input);
        complete_selection(selection, options.selection, mesh);
        report(options, fmt::format("read {}", options.input.path), mesh, watch.lap());
    });
    world.broadcast(selection.cells);

    const std::size_t cells_before = mesh.cells.size();
    const Refined fine =
        options.engine == Engine::reference
            ? refine_by_reference(mesh, selection, options, world)
            : refine_distributed(std::move(mesh), selection, options, partition, world);
    distributed::on_first(world, [&] {
        report(options, refined_line(options, world), fine.mesh, watch.lap());
        if (options.levels > 0 && fine.mesh.cells.size() == cells_before) {
            note("no cell was chosen: the mesh stays as it is");
        }
        write_output(fine.mesh, options.output, {.cell_to_parent = &fine.maps.cell_to_parent});
        if (!options.maps.empty()) write_maps(fine.maps, options.maps);
        report(options, fmt::format("wrote {}", options.output), fine.mesh, watch.lap());
    });
}

void add_engine_options(CLI::App& command, RefineOptions& options) {
    const std::string group = "How it is done (the result is the same bytes)";
    const std::map<std::string, Engine> engines{{"distributed", Engine::distributed},
                                                {"reference", Engine::reference}};
    command
        .add_option("--engine", options.engine,
                    "the fast one, over MPI under mpirun, or the serial reference [distributed]")
        ->type_name("distributed|reference")
        ->transform(CLI::CheckedTransformer(engines).description(""))
        ->group(group);
    command
        .add_option("--partition", options.partition,
                    "which rank gets which cell: lepp, dual, block, random:SEED, file:PATH [lepp]")
        ->type_name("METHOD")
        ->group(group);
    using distributed::Synchronisation;
    const std::map<std::string, Synchronisation> ways{{"neighbour", Synchronisation::neighbour},
                                                      {"gateway", Synchronisation::gateway}};
    command
        .add_option("--sync", options.synchronisation,
                    "ranks tell their neighbours, or the first rank, which tells the others "
                    "[neighbour]")
        ->type_name("neighbour|gateway")
        ->transform(CLI::CheckedTransformer(ways).description(""))
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
    add_selection_options(*refine_command, options->selection);
    refine_command
        ->add_option(
            "--levels", options->levels,
            "how often to choose and bisect; what is chosen is judged afresh each time [1]")
        ->type_name("L")
        ->check(CLI::Range(0, 50));
    const std::map<std::string, Scheme> schemes{
        {"8t", Scheme::eight}, {"4t", Scheme::four}, {"2t", Scheme::two}};
    refine_command
        ->add_option("--scheme", options->scheme,
                     "a chosen cell selects all its edges, its faces' longest, or its longest [8t]")
        ->type_name("8t|4t|2t")
        ->transform(CLI::CheckedTransformer(schemes).description(""));
    add_engine_options(*refine_command, *options);
    refine_command
        ->add_option("--maps", options->maps,
                     "also write each cell's parent and each midpoint's edge, as text")
        ->type_name("FILE");
    refine_command->add_flag("--quiet", options->quiet, "print nothing but notes and errors");
    refine_command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu\n"
        "On four ranks: mpirun -n 4 octetra refine ...");
    refine_command->callback([options, world] { refine(*options, world); });
}

}  // namespace octetra::cli
