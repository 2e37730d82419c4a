#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octetra::cli {

/// An argument and the files that it refers to: one, or several for a TetGen mesh.
struct NamedFiles {
    std::string_view argument;  ///< "MESH", "--maps" ...
    std::vector<std::filesystem::path> files;
};

/// Returns the files of an input mesh.
[[nodiscard]] NamedFiles mesh_named(std::string_view argument, const std::filesystem::path& path);

/// Returns the file `path`, or none if it is empty.
[[nodiscard]] NamedFiles file_named(std::string_view argument, const std::filesystem::path& path);

/// Returns all files that writing a mesh to `path` replaces or removes; for a `.pvtu`, with this
/// many pieces.
[[nodiscard]] NamedFiles mesh_to_write(std::string_view argument, const std::filesystem::path& path,
                                       int pieces = 1);

/// Throws InputError if an output file is an input file, also by another name or a link, or if two
/// arguments refer to the same output file.
void check_distinct_files(const std::vector<NamedFiles>& read,
                          const std::vector<NamedFiles>& written);

/// Throws InputError: two arguments refer to the same output file by these names.
[[noreturn]] void refuse_same_file(std::string_view one, const std::filesystem::path& its_name,
                                   std::string_view other,
                                   const std::filesystem::path& the_others_name);

}  // namespace octetra::cli
