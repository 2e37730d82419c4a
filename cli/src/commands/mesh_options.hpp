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

#include "commands/files_apart.hpp"

/// What every subcommand that reads or writes a mesh has in common.
namespace octetra::cli {

struct InputOptions {
    std::string path;
    bool fix_orientation = false;
    std::string fields;  ///< a .sol or .solb of MESH; empty: none
};

/// Declares the positional MESH and --fix-orientation.
void add_input_options(CLI::App& subcommand, InputOptions& options);

/// Declares --fields FILE.
void add_fields_option(CLI::App& subcommand, InputOptions& options);

/// All that a mesh written at `path` replaces or removes, and the file of fields beside it, if MESH
/// may have some.
[[nodiscard]] NamedFiles output_to_write(std::string_view argument, const InputOptions& options,
                                         const std::filesystem::path& path, int ranks = 1);
/// Refuses, before the work, an output and what goes beside it. Throws InputError.
void check_output_with_fields(const InputOptions& options, const std::filesystem::path& output,
                              int ranks = 1);

/// Collective. Adds the fields of --fields, if it is given, to those that MESH has. One that would
/// have the name of another gets `_field` behind its own.
void read_fields(const distributed::AdaptiveMesh& mesh, const InputOptions& options,
                 std::vector<distributed::Field>& fields);

/// Declares -o OUT.
void add_output_option(CLI::App& subcommand, std::string& path);

/// Refuses, before the work, a path that no mesh, and no checkpoint, can be written at by so many
/// ranks. Throws InputError.
void check_output(const std::filesystem::path& path, int ranks = 1);

/// Does a file of this name say what cells came from? Checkpoints do, and the formats that have
/// each cell's parent.
[[nodiscard]] bool tells_history(const std::filesystem::path& path);

/// Refuses, before the work, a path for a file beside the mesh (maps, parts) that cannot be written
/// or would take the place of a mesh. Throws InputError.
void check_side_file(std::string_view option, const std::filesystem::path& path);

/// Refuses, before the work, a path that no series of meshes can be written at. Throws InputError.
void check_series(const std::filesystem::path& path);

/// What an option takes that is the name of a file: anything but "".
[[nodiscard]] CLI::Validator names_a_file();

/// A remark on stderr that is not an error: "octetra: note: ...".
void note(std::string_view what);

/// The note for a result that does not hold the time, step and text of the checkpoint it is made
/// from.
[[nodiscard]] std::string state_is_lost(const std::string& checkpoint);

/// How a mesh is read: what is noted goes to stderr.
[[nodiscard]] ReadOptions read_options(const InputOptions& options);
[[nodiscard]] Mesh read_input(const InputOptions& options);
/// For whoever judges the mesh: of a file, whatever reads as one.
[[nodiscard]] Mesh read_as_it_stands(const std::string& path);

/// "wrote PATH: ... vertices, ... cells, ... facets" on stdout.
void report_written(const Mesh& mesh, const std::string& path);

/// Writes the mesh; notes on stderr what the format cannot hold.
void write_output(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

}  // namespace octetra::cli
