#include <cstdint>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/certify_shapes.hpp>

#include "commands/commands.hpp"
#include "commands/mesh_options.hpp"
#include "commands/number_options.hpp"
#include "info/print_certificate.hpp"
#include "verdict/check_progress.hpp"

namespace octetra::cli {
namespace {

struct CertifyCommandOptions {
    std::string path;
    bool json = false;
    std::uint64_t limit = verify::CertifyOptions{}.limit;
};

/// Collective. No process but the first, and that for a checkpoint only, holds the whole mesh.
verify::MeshSlice read_input_cells(const std::string& path,
                                   const distributed::Communicator& world) {
    if (!is_checkpoint(path)) {
        return verify::read_slice(path, {.only_syntax = true, .note = note}, world);
    }
    Mesh input;
    world.on_first([&] { input = read_checkpoint(path).input; });
    return verify::distribute_slices(input, world);
}

/// Collective.
void run(const CertifyCommandOptions& given, const distributed::Communicator& world) {
    const verify::MeshSlice mesh = read_input_cells(given.path, world);
    verify::CertifyOptions options{.limit = given.limit};
    CheckProgress progress;
    if (world.is_first()) options.progress = progress.progress_callback();
    verify::ShapeCertificate certificate;
    try {
        certificate = verify::certify_shapes(mesh, world, options);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", given.path, error.what()));
    }
    progress.clear();
    world.on_first([&] {
        const std::uint32_t index_base = mesh.lists.index_base;
        given.json ? print_certificate_json(certificate, index_base)
                   : print_certificate(certificate, given.path, index_base);
    });
}

}  // namespace

void add_certify(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<CertifyCommandOptions>();
    CLI::App* command =
        program.add_subcommand("certify", "Bound the angles of all regular refinements of a mesh");
    command
        ->add_option("MESH", options->path,
                     "the mesh: .ele, .node, .mesh, .meshb or .msh; of a .octetra file, its input")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    command->add_flag("--json", options->json, "print JSON instead of a table");
    constexpr std::uint64_t most = 100'000'000;
    add_number<std::uint64_t>(*command, "--limit", options->limit, {1, most, "1 to 100000000"},
                              "give up closing the set of shapes of a cell that has more than N "
                              "(10000)")
        ->type_name("N");
    command->footer(
        "Exit status: 0 certified, perhaps to a generation only; 2 bad usage, or a mesh that "
        "cannot\n"
        "be read or has a flat or inverted cell; 3 the system failed.\n"
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra certify gear.1.ele\n"
        "  mpirun -n 2 octetra certify gear.1.ele --json");
    command->callback([options, world] { run(*options, world); });
}

}  // namespace octetra::cli
