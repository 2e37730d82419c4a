#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octetra::cli {

/// What one argument names: a file, or the several of a TetGen mesh.
struct NamedFiles {
    std::string_view argument;  ///< "MESH", "--maps" ...
    std::vector<std::filesystem::path> files;
};

/// The files of the mesh `path`, which is read.
[[nodiscard]] NamedFiles mesh_named(std::string_view argument, const std::filesystem::path& path);

/// The file `path`; none, if that is empty.
[[nodiscard]] NamedFiles file_named(std::string_view argument, const std::filesystem::path& path);

/// All that a mesh written at `path` replaces or removes; of a `.pvtu` so many pieces.
[[nodiscard]] NamedFiles mesh_to_write(std::string_view argument, const std::filesystem::path& path,
                                       int pieces = 1);

/// Throws InputError if a file to write is one to read, even by another name or a link; or if two
/// arguments name one file to write.
void check_files_apart(const std::vector<NamedFiles>& read, const std::vector<NamedFiles>& written);

/// Throws InputError: two arguments name one file to write, by these names.
[[noreturn]] void refuse_same_file(std::string_view one, const std::filesystem::path& its_name,
                                   std::string_view other,
                                   const std::filesystem::path& the_others_name);

}  // namespace octetra::cli
