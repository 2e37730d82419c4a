#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "commands/distinct_files.hpp"

/// Options and functions common to the subcommands that read or write a mesh.
namespace octetra::cli {

struct InputOptions {
    std::string path;
    bool fix_orientation = false;
    std::string fields;  ///< a .sol or .solb file of MESH; empty: none
};

/// Declares the positional MESH and --fix-orientation.
void add_input_options(CLI::App& subcommand, InputOptions& options);

/// Declares --fields FILE.
void add_fields_option(CLI::App& subcommand, InputOptions& options);

/// Returns all files that writing a mesh to `path` replaces or removes, including the accompanying
/// file of fields, if MESH may have any.
[[nodiscard]] NamedFiles output_to_write(std::string_view argument, const InputOptions& options,
                                         const std::filesystem::path& path, int ranks = 1);
/// Checks in advance an output and its accompanying files. Throws InputError.
void check_output_with_fields(const InputOptions& options, const std::filesystem::path& output,
                              int ranks = 1);

/// Collective. Appends the fields of --fields, if given, to those of MESH. `_field` is appended to
/// a name that is already in use.
void read_fields(const distributed::AdaptiveMesh& mesh, const InputOptions& options,
                 std::vector<distributed::Field>& fields);

/// Declares -o OUT.
void add_output_option(CLI::App& subcommand, std::string& path);

/// Checks in advance that a mesh or checkpoint can be written to the path by this many ranks.
/// Throws InputError.
void check_output(const std::filesystem::path& path, int ranks = 1);

/// Returns whether a file of this name records the origin of cells: a checkpoint, or a format that
/// contains the parent of each cell.
[[nodiscard]] bool records_origins(const std::filesystem::path& path);

/// Checks in advance that an additional file (maps, parts) can be written to the path and would not
/// replace a mesh. Throws InputError.
void check_side_file(std::string_view option, const std::filesystem::path& path);

/// Checks in advance that a series of meshes can be written to the path. Throws InputError.
void check_series(const std::filesystem::path& path);

/// A validator of file names: any text except "".
[[nodiscard]] CLI::Validator file_name_validator();

/// Prints a note to stderr: "octetra: note: ...".
void note(std::string_view what);

/// Returns the note for a result that does not contain the time, step and text of its checkpoint.
[[nodiscard]] std::string state_is_lost(const std::string& checkpoint);

/// Options for reading a mesh, with notes printed to stderr.
[[nodiscard]] ReadOptions read_options(const InputOptions& options);
[[nodiscard]] Mesh read_input(const InputOptions& options);
/// Reads a mesh without semantic checks, for verification.
[[nodiscard]] Mesh read_without_checks(const std::string& path);

/// Prints "wrote PATH: ... vertices, ... cells, ... facets" to stdout.
void report_written(const Mesh& mesh, const std::string& path);

/// Writes the mesh; prints notes on data that the format cannot hold.
void write_output(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

}  // namespace octetra::cli
