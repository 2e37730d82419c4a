#include "commands/mesh_options.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_formats.hpp>

#include "grouped.hpp"
#include "terminal.hpp"

namespace octetra::cli {

void add_input_options(CLI::App& subcommand, InputOptions& options) {
    subcommand
        .add_option(
            "MESH", options.path,
            "the mesh: .ele or .node (TetGen), .mesh or .meshb (Medit), .msh (Gmsh), .octetra")
        ->type_name("")
        ->check(file_name_validator())
        ->required();
    subcommand.add_flag("--fix-orientation", options.fix_orientation,
                        "reverse inverted cells instead of rejecting the mesh");
}

void add_fields_option(CLI::App& subcommand, InputOptions& options) {
    subcommand
        .add_option("--fields", options.fields,
                    "fields on MESH's vertices and cells to be transferred: .sol or .solb (Medit)")
        ->type_name("FILE")
        ->check(file_name_validator());
}

namespace {

/// Returns the file of fields written with a Medit mesh, if MESH may have fields.
std::optional<std::filesystem::path> fields_beside(const InputOptions& options,
                                                   const std::filesystem::path& output) {
    if (options.fields.empty() && !is_checkpoint(options.path)) return {};
    return sol_path_for(output);
}

}  // namespace

NamedFiles output_to_write(std::string_view argument, const InputOptions& options,
                           const std::filesystem::path& path, int ranks) {
    NamedFiles written = mesh_to_write(argument, path, ranks);
    if (const auto beside = fields_beside(options, path)) written.files.push_back(*beside);
    return written;
}

void check_output_with_fields(const InputOptions& options, const std::filesystem::path& output,
                              int ranks) {
    check_output(output, ranks);
    if (!options.fields.empty() && !is_sol(options.fields)) {
        throw InputError(
            fmt::format("--fields: {}: files of values end in .sol or .solb", options.fields));
    }
    if (const auto beside = fields_beside(options, output)) check_output_path(*beside);
}

void read_fields(const distributed::AdaptiveMesh& mesh, const InputOptions& options,
                 std::vector<distributed::Field>& fields) {
    if (options.fields.empty()) return;
    for (distributed::Field& field : mesh.read_fields(options.fields, note)) {
        const auto is_taken = [&](const distributed::Field& other) {
            return other.on == field.on && other.name == field.name;
        };
        while (std::ranges::any_of(fields, is_taken)) field.name += "_field";
        fields.push_back(std::move(field));
    }
}

void add_output_option(CLI::App& subcommand, std::string& path) {
    subcommand
        .add_option(
            "-o,--output", path,
            "the output: .ele, .mesh, .meshb, .msh, .octetra, .vtu, .pvtu, .vtkhdf or .xdmf")
        ->type_name("OUT")
        ->check(file_name_validator())
        ->required();
}

CLI::Validator file_name_validator() {
    const auto refusal = [](const std::string& name) {
        if (name.empty()) return std::string("'' is not a file name");
        if (name.front() != '=') return std::string();
        return fmt::format("'{}' begins with =; leave it out, or write ./{}", name, name);
    };
    return {refusal, ""};
}

void check_output(const std::filesystem::path& path, int ranks) {
    is_checkpoint(path) ? check_output_path(path) : check_writable(path, ranks);
}

bool records_origins(const std::filesystem::path& path) { return mesh_format_of(path).parents; }

void check_side_file(std::string_view option, const std::filesystem::path& path) {
    if (path == "-") {
        throw InputError(
            fmt::format("{}: - is not a file name; write ./- for a file of that name", option));
    }
    if (is_mesh_file(path)) {
        throw InputError(fmt::format("{}: {} is the name of a mesh file; choose another", option,
                                     path.native()));
    }
    check_output_path(path);
}

void check_series(const std::filesystem::path& path) {
    if (format_of(path) != Format::vtkhdf) {
        throw InputError(fmt::format("--series: {}: a series is a .vtkhdf file", path.native()));
    }
    check_output_path(path);
}

void note(std::string_view what) { print_message("note: {}", what); }

std::string state_is_lost(const std::string& checkpoint) {
    return fmt::format(
        "the result does not contain the time, step and text that a program saved in {}",
        checkpoint);
}

void report_written(const Mesh& mesh, const std::string& path) {
    print(
        "wrote {}: {} vertices, {} cells{}\n", path, grouped(mesh.points.size()),
        grouped(mesh.cells.size()),
        mesh_format_of(path).facets ? fmt::format(", {} facets", grouped(mesh.facets.size())) : "");
}

namespace {

Mesh load_serial(const std::string& path) {
    return distributed::AdaptiveMesh::load(distributed::Communicator(), path).collect();
}

}  // namespace

Mesh read_without_checks(const std::string& path) {
    if (is_checkpoint(path)) return load_serial(path);
    return read_mesh(path, {.only_syntax = true, .note = note});
}

ReadOptions read_options(const InputOptions& options) {
    return {.fix_orientation = options.fix_orientation, .note = note};
}

Mesh read_input(const InputOptions& options) {
    if (is_checkpoint(options.path)) return load_serial(options.path);
    return read_mesh(options.path, read_options(options));
}

void write_output(const Mesh& mesh, const std::string& path, const WriteOptions& options) {
    if (is_checkpoint(path)) {
        using distributed::AdaptiveMesh;
        return AdaptiveMesh::distribute(distributed::Communicator(), mesh, {}).save(path);
    }
    const std::string lost = write_mesh(mesh, path, options);
    if (!lost.empty()) note(lost);
}

}  // namespace octetra::cli
