#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/compare.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "negative_answer.hpp"
#include "terminal.hpp"
#include "verdict/print_verdict.hpp"

namespace octetra::cli {
namespace {

struct CompareOptions {
    std::string a;
    std::string b;
    bool identical = false;
    std::optional<double> tolerance;
};

bool run(const CompareOptions& options) {
    const Mesh a = read_without_checks(options.a);
    Mesh b = read_without_checks(options.b);
    const auto comparison = options.tolerance
                                ? verify::compare_within(*options.tolerance, a, std::move(b))
                                : verify::compare(a, b);
    print_comparison(comparison, options.a, options.b);
    if (options.tolerance && comparison.difference_count > 0) {
        print("if the differences are due to rounding, --tolerance must be above {:.3g}\n",
              *options.tolerance);
    }
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
    CLI::Option* identical =
        command->add_flag("--identical", options->identical, "also require the same numbering");
    add_number<double>(*command, "--tolerance", options->tolerance,
                       {0, std::numeric_limits<double>::max(), "0 up"},
                       "take vertices at most T apart for the same vertex [0]")
        ->type_name("T")
        ->excludes(identical);
    command->footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra convert gear.1.ele gear.mesh\n"
        "  octetra compare gear.1.ele gear.mesh\n"
        "  octetra compare gear.1.ele gear.mesh --tolerance 1e-12");
    command->callback([options, world] {
        std::vector<char> same{0};
        world.on_first([&] { same.front() = run(*options) ? 1 : 0; });
        world.broadcast(same);
        if (same.front() == 0) throw NegativeAnswer{};
    });
}

}  // namespace octetra::cli
