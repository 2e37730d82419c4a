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
#include <octetra/reference/refine.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/selection_options.hpp"
#include "grouped.hpp"
#include "stopwatch.hpp"

namespace octetra::cli {
namespace {

struct RefineOptions {
    InputOptions input;
    std::string output;
    std::string maps;
    SelectionOptions selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
    std::string engine = "reference";
    bool quiet = false;
};

void report(const RefineOptions& options, std::string_view doing, const Mesh& mesh,
            double seconds) {
    if (options.quiet) return;
    fmt::print("{:<30} {:>13} vertices {:>13} cells {:>8.2f} s\n", doing,
               grouped(mesh.points.size()), grouped(mesh.cells.size()), seconds);
    std::fflush(stdout);
}

reference::Refinement run_engine(const Mesh& mesh, const Selection& selection,
                                 const RefineOptions& options) {
    try {
        return reference::refine(mesh, selection, options.scheme, options.levels);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", options.input.path, error.what()));
    }
}

/// The maps may not take the place of a mesh, be it the input or one of the files just written.
void check_maps_path(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 6> mesh_files{".ele",  ".node", ".face",
                                                         ".edge", ".mesh", ".vtu"};
    if (std::ranges::find(mesh_files, path.extension()) != mesh_files.end()) {
        throw InputError(fmt::format("--maps: {} is the name of a mesh file; give the maps another",
                                     path.native()));
    }
    check_place(path);
}

void refine(const RefineOptions& options) {
    Selection selection = parse_selection(options.selection);
    check_writable(options.output);
    if (!options.maps.empty()) check_maps_path(options.maps);

    Stopwatch watch;
    const Mesh mesh = read_input(options.input);
    complete_selection(selection, options.selection, mesh);
    report(options, fmt::format("read {}", options.input.path), mesh, watch.lap());

    const reference::Refinement fine = run_engine(mesh, selection, options);
    report(options,
           fmt::format("refined, {} level{}", options.levels, options.levels == 1 ? "" : "s"),
           fine.mesh, watch.lap());
    if (options.levels > 0 && fine.mesh.cells.size() == mesh.cells.size()) {
        note("no cell was chosen: the mesh stays as it is");
    }

    write_output(fine.mesh, options.output, {.cell_to_parent = &fine.maps.cell_to_parent});
    if (!options.maps.empty()) write_maps(fine.maps, options.maps);
    report(options, fmt::format("wrote {}", options.output), fine.mesh, watch.lap());
}

}  // namespace

void add_refine(CLI::App& program) {
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
    refine_command
        ->add_option("--engine", options->engine, "the serial reference is the only one so far")
        ->type_name("reference")
        ->check(CLI::IsMember({"reference"}).description(""));
    refine_command
        ->add_option("--maps", options->maps,
                     "also write each cell's parent and each midpoint's edge, as text")
        ->type_name("FILE");
    refine_command->add_flag("--quiet", options->quiet, "print nothing but notes and errors");
    refine_command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu");
    refine_command->callback([options] { refine(*options); });
}

}  // namespace octetra::cli
