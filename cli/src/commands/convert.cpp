#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/unused_vertices.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/communicator.hpp>

#include "choice.hpp"
#include "commands/commands.hpp"
#include "commands/distinct_files.hpp"
#include "commands/mesh_options.hpp"
#include "grouped.hpp"

namespace octetra::cli {
namespace {

struct ConvertOptions {
    InputOptions input;
    std::string output;
    std::string msh_format;  // empty: the default of write_mesh()
    bool drop_unused = false;
    bool quiet = false;
};

/// Parses --msh-format. Throws InputError if it does not apply to this output.
WriteOptions write_options(const ConvertOptions& options) {
    if (options.msh_format.empty()) return {};
    constexpr std::array<Word<MshFormat>, 4> words{{{"4.1", {}},
                                                    {"4.1-text", {.is_text = true}},
                                                    {"2.2", {.is_2 = true}},
                                                    {"2.2-text", {.is_2 = true, .is_text = true}}}};
    const MshFormat format = parse_choice("--msh-format", options.msh_format, words);
    if (std::filesystem::path(options.output).extension() == ".msh") return {.msh = format};
    throw InputError(
        fmt::format("--msh-format applies only to .msh files, not {}", options.output));
}

/// Converts a mesh with fields, or a checkpoint, with all its data that the output can hold.
void convert_with_fields(const ConvertOptions& options, const WriteOptions& writing) {
    using distributed::AdaptiveMesh;
    const distributed::Communicator alone;
    std::vector<distributed::Field> fields;
    const auto mesh = is_checkpoint(options.input.path)
                          ? AdaptiveMesh::load(alone, options.input.path, {}, &fields)
                          : AdaptiveMesh::distribute(alone, read_input(options.input), {});
    read_fields(mesh, options.input, fields);
    std::optional<SavedState> state;
    if (is_checkpoint(options.input.path)) {
        state = read_checkpoint_facts(options.input.path).state;
    }
    if (is_checkpoint(options.output)) {
        mesh.save(options.output, fields, state);
    } else {
        if (state) note(state_is_lost(options.input.path));
        const std::string lost = mesh.write(options.output, fields, writing);
        if (!lost.empty()) note(lost);
    }
    if (!options.quiet) report_written(mesh.collect(), options.output);
}

/// Throws InputError if --drop-unused is given for data that refer to the numbers of vertices.
void check_drop_unused(const ConvertOptions& options) {
    if (!options.drop_unused) return;
    if (is_checkpoint(options.input.path)) {
        throw InputError(
            fmt::format("--drop-unused: the steps and fields in {} refer to all vertices; drop "
                        "them from the input, before refinement",
                        options.input.path));
    }
    if (!options.input.fields.empty()) {
        throw InputError(
            "--drop-unused cannot be combined with --fields, which has a value for "
            "each vertex of MESH");
    }
}

void drop_unused(Mesh& mesh, const std::string& path) {
    const std::uint64_t dropped = drop_unused_vertices(mesh);
    if (dropped > 0) {
        note(fmt::format("dropped {} vert{} of no cell of {}", grouped(dropped),
                         dropped == 1 ? "ex" : "ices", path));
    }
}

void convert(const ConvertOptions& options) {
    const WriteOptions writing = write_options(options);
    check_drop_unused(options);
    check_output_with_fields(options.input, options.output);
    check_distinct_files(
        {mesh_named("MESH", options.input.path), file_named("--fields", options.input.fields)},
        {output_to_write("OUT", options.input, options.output)});
    if (is_checkpoint(options.input.path) || !options.input.fields.empty()) {
        return convert_with_fields(options, writing);
    }
    Mesh mesh = read_input(options.input);
    if (options.drop_unused) drop_unused(mesh, options.input.path);
    write_output(mesh, options.output, writing);
    if (!options.quiet) report_written(mesh, options.output);
}

}  // namespace

void add_convert(CLI::App& program, const distributed::Communicator& world) {
    auto options = std::make_shared<ConvertOptions>();
    CLI::App* command = program.add_subcommand(
        "convert", "Convert a mesh to another format; coordinates are preserved exactly");
    add_input_options(*command, options->input);
    add_fields_option(*command, options->input);
    command
        ->add_option(
            "OUT", options->output,
            "the output: .ele, .mesh, .meshb, .msh, .octetra, .vtu, .pvtu, .vtkhdf or .xdmf")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    command
        ->add_option("--msh-format", options->msh_format,
                     "the version of .msh: 4.1 or 2.2, binary; 4.1-text or 2.2-text [4.1]")
        ->type_name("WORD");
    command->add_flag("--drop-unused", options->drop_unused,
                      "drop vertices of no cell, and renumber the others in their order");
    command->add_flag("--quiet", options->quiet, "print only notes and errors");
    command->footer(
        "Example:\n"
        "  octetra generate torus -o torus.1.ele\n"
        "  octetra convert torus.1.ele torus.mesh\n"
        "  octetra convert torus.mesh torus.msh --msh-format 2.2-text");
    command->callback([options, world] { world.on_first([&] { convert(*options); }); });
}

}  // namespace octetra::cli
