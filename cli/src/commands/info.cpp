#include <cstddef>
#include <memory>

#include <CLI/CLI.hpp>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/levels.hpp>
#include <octetra/quality/mesh_statistics.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "info/print_statistics.hpp"

namespace octetra::cli {
namespace {

struct InfoOptions {
    InputOptions input;
    bool json = false;
};

void show_mesh(const InfoOptions& options) {
    const Mesh mesh = read_input(options.input);
    const quality::MeshStatistics statistics = quality::measure(mesh);
    if (options.json) return print_json(statistics, nullptr, mesh.group_names);
    print_table(statistics, mesh.group_names);
}

void show_checkpoint(const InfoOptions& options) {
    History history{.facts = read_checkpoint_facts(options.input.path), .levels = {}};
    const auto state =
        distributed::AdaptiveMesh::load(distributed::Communicator(), options.input.path);
    const distributed::Levels levels = state.levels();
    for (std::size_t k = 0; k < levels.count(); ++k) {
        history.levels.push_back({levels.step(k), levels.vertex_count(k)});
    }
    const quality::MeshStatistics statistics = quality::measure(state.collect());
    if (options.json) return print_json(statistics, &history, history.facts.group_names);
    print_table(statistics, history.facts.group_names);
    print_history(history);
}

}  // namespace

void add_info(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand(
        "info", "Counts, size, volume, shapes of the cells and adjacency of a mesh");
    add_input_options(*command, options->input);
    command->add_flag("--json", options->json, "print JSON instead of a table");
    command->footer(
        "Example:\n"
        "  octetra generate kuhn 4 -o cube.1.ele\n"
        "  octetra info cube.1.ele --json");
    command->callback([options, world] {
        world.on_first([&] {
            is_checkpoint(options->input.path) ? show_checkpoint(*options) : show_mesh(*options);
        });
    });
}

}  // namespace octetra::cli
