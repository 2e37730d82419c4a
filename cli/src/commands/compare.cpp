#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/compare.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "negative_answer.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

struct CompareOptions {
    std::string a;
    std::string b;
    bool identical = false;
};

bool run(const CompareOptions& options) {
    const auto comparison =
        verify::compare(read_without_checks(options.a), read_without_checks(options.b));
    print_comparison(comparison, options.a, options.b);
    return comparison.likeness == verify::Likeness::identical ||
           (!options.identical && comparison.likeness == verify::Likeness::up_to_numbering);
}

}  // namespace

void add_compare(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand(
        "compare",
        "Compare two meshes, up to their numbering.\n"
        "Exits with status 0 if they are the same, 1 if not, 2 if one cannot be read.");
    command->add_option("A", options->a, "a mesh")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    command->add_option("B", options->b, "another")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    command->add_flag("--identical", options->identical, "also require the same numbering");
    command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra convert gear.1.ele gear.mesh\n"
        "  octetra compare gear.1.ele gear.mesh");
    command->callback([options, world] {
        std::vector<char> same{0};
        world.on_first([&] { same.front() = run(*options) ? 1 : 0; });
        world.broadcast(same);
        if (same.front() == 0) throw NegativeAnswer{};
    });
}

}  // namespace octetra::cli
