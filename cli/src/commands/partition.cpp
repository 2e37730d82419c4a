#include <algorithm>
#include <memory>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/select_cells.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>

#include "commands/commands.hpp"
#include "commands/distinct_files.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "commands/parallel_options.hpp"
#include "commands/refinement_options.hpp"
#include "grouped.hpp"
#include "terminal.hpp"

namespace octetra::cli {
namespace {

struct PartitionOptions {
    InputOptions input;
    int parts = 0;
    std::string method = "rcb";
    std::string output;
    RefinementOptions refinement;
    bool has_refinement_options =
        false;  ///< whether such options were given, even with default values
};

void print_counts(std::string_view what, const std::vector<std::uint64_t>& counts) {
    const auto sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const auto mean = static_cast<double>(sum) / static_cast<double>(counts.size());
    const std::uint64_t most = std::ranges::max(counts);
    print("{:<34} {:>11} {:>13.1f} {:>13} {:>9.3f}\n", what, grouped(std::ranges::min(counts)),
          mean, grouped(most), mean > 0 ? static_cast<double>(most) / mean : 1.0);
}

void print_cut(std::string_view what, std::uint64_t cut, std::uint64_t all) {
    const double share = all == 0 ? 0 : 100 * static_cast<double>(cut) / static_cast<double>(all);
    print("{:<34} {:>11} of {:>13}   {:6.2f} %\n", what, grouped(cut), grouped(all), share);
}

void print_statistics(const distributed::PartitionStatistics& statistics) {
    print_cut("cut faces", statistics.cut_faces, statistics.inner_faces);
    print_cut("cut links through longest edges", statistics.cut_longest_edge_links,
              statistics.longest_edge_links);
    print("\n{:<34} {:>11} {:>13} {:>13} {:>9}\n", "of a part", "least", "mean", "most",
          "most/mean");
    print_counts("cells", statistics.cells_of_part);
    print_counts("vertices shared with other parts", statistics.shared_vertices_of_part);
    print_counts("neighbouring parts", statistics.neighbours_of_part);
}

void note_empty_parts(const std::vector<std::uint64_t>& cells_of_part) {
    const auto empty = static_cast<std::size_t>(std::ranges::count(cells_of_part, 0U));
    if (empty == 0) return;
    note(fmt::format("{} of {} parts have no cell", grouped(empty), grouped(cells_of_part.size())));
}

/// Returns the weights that `octetra refine` with the same criteria would use; empty without
/// criteria.
std::vector<float> weights_of(const Mesh& mesh, const PartitionOptions& options) {
    const SelectionOptions& typed = options.refinement.selection;
    if (!has_criterion(typed)) {
        if (!options.has_refinement_options) return {};
        throw InputError(
            "partition: --levels, --scheme and --seed require a selection, as in --sphere X,Y,Z,R "
            "--levels 2");
    }
    Selection selection = parse_selection(typed);
    if (const auto terms = external_terms(selection); !terms.empty()) {
        throw InputError(
            fmt::format("partition: {} is not known before refinement, and cannot "
                        "predict where cells become many",
                        text_of(terms.front())));
    }
    if (!selection.where.empty()) {
        note("expressions do not predict where cells become many: they do not affect the parts");
    }
    check_regions(typed, mesh.regions, ProcessGroup::alone());
    complete_selection(selection, typed,
                       {mesh.index_base, mesh.cells.size(), SharedGroupNames(mesh.group_names)});
    return distributed::predicted_cells(mesh, selection, parse_scheme(options.refinement),
                                        options.refinement.levels);
}

void print_expected(const std::vector<int>& cell_to_part, const std::vector<float>& weights,
                    int parts) {
    if (weights.empty()) return;
    std::vector<double> expected(static_cast<std::size_t>(parts), 0);
    for (std::size_t c = 0; c < cell_to_part.size(); ++c) {
        expected[static_cast<std::size_t>(cell_to_part[c])] += weights[c];
    }
    print_counts("cells expected after refinement", {expected.begin(), expected.end()});
}

void partition(const PartitionOptions& options) {
    const auto method = partition_named(options.method);
    if (!options.output.empty()) check_side_file("-o", options.output);
    check_distinct_files(
        {mesh_named("MESH", options.input.path), file_named("--partition", method.path),
         file_named("--cells", options.refinement.selection.cells_file)},
        {file_named("-o", options.output)});
    const Mesh mesh = read_input(options.input);
    const std::vector<float> weights = weights_of(mesh, options);
    const auto cell_to_part = distributed::partition_cells(mesh, options.parts, method, weights);
    print("{}: {} cell{} in {} parts by {}\n\n", options.input.path, grouped(mesh.cells.size()),
          mesh.cells.size() == 1 ? "" : "s", options.parts, options.method);
    const auto statistics = distributed::measure_partition(mesh, cell_to_part, options.parts);
    print_statistics(statistics);
    print_expected(cell_to_part, weights, options.parts);
    note_empty_parts(statistics.cells_of_part);
    if (options.output.empty()) return;
    write_list(cell_to_part, options.output);
    print("\nwrote {}: the part of each cell, for --partition file:{}\n", options.output,
          options.output);
}

}  // namespace

void add_partition(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<PartitionOptions>();
    CLI::App* command =
        program.add_subcommand("partition", "Partition a mesh, and print statistics of the parts");
    add_input_options(*command, options->input);
    add_number<std::uint64_t>(*command, "-n,--parts", options->parts,
                              {1, 1'000'000, "1 to 1000000"}, "number of parts")
        ->type_name("P")
        ->required();
    command
        ->add_option("--partition", options->method,
                     "rcb, lepp, dual, block, random:SEED or file:PATH [rcb]")
        ->type_name("METHOD");
    command
        ->add_option("-o,--output", options->output,
                     "also write the part of each cell, one per line")
        ->type_name("FILE")
        ->check(file_name_validator());
    add_refinement_options(
        *command, options->refinement,
        "Balance the cells expected after refinement of these cells (as for refine)");
    command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra partition gear.1.ele -n 4\n"
        "  octetra partition gear.1.ele -n 4 --sphere 1,0,0.15,0.4 --levels 2");
    command->callback([options, command, world] {
        options->has_refinement_options = has_refinement_options(*command);
        group_criteria(*command, options->refinement.selection);
        world.on_first([&] { partition(*options); });
    });
}

}  // namespace octetra::cli
