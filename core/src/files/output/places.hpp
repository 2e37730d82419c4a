#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Where files are put, and what may stand in the way.
namespace octetra {

/// Why no file can be put at `path`, or where its links lead; or nothing.
[[nodiscard]] std::string in_the_way(const std::filesystem::path& path);

/// Throws InputError unless every file that a mesh written at `path` is can be put in its place,
/// and no two in the same one.
void check_places(const std::filesystem::path& path, int pieces);

/// The piece of a `.pvtu` that a rank writes.
[[nodiscard]] std::filesystem::path piece_path(const std::filesystem::path& path, int rank);

/// The file of values that a `.xdmf` names.
[[nodiscard]] std::filesystem::path h5_beside(const std::filesystem::path& path);

/// The files with this extension, `.face` or `.edge`, that would be read with a TetGen mesh
/// written at `path`: the one beside its name and, where its `.node` or `.ele` is a link, the one
/// beside what that leads to.
[[nodiscard]] std::vector<std::filesystem::path> lists_read_with(const std::filesystem::path& path,
                                                                 std::string_view extension);

}  // namespace octetra
