#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Paths of output files, and checks that they can be written.
namespace octetra {

/// Returns the reason why no file can be written at `path` or its link target, or an empty string.
[[nodiscard]] std::string write_obstacle(const std::filesystem::path& path);

/// Throws InputError unless every file of a mesh written at `path` can be written, and all are
/// different.
void check_places(const std::filesystem::path& path, int pieces);

/// Returns the path of the piece of a `.pvtu` that a rank writes.
[[nodiscard]] std::filesystem::path piece_path(const std::filesystem::path& path, int rank);

/// Returns the path of the HDF5 file that a `.xdmf` refers to.
[[nodiscard]] std::filesystem::path h5_beside(const std::filesystem::path& path);

/// Returns the files with this extension, `.face` or `.edge`, that would be read with a TetGen mesh
/// written at `path`: the one next to it and, if its `.node` or `.ele` is a link, the one next to
/// the link target.
[[nodiscard]] std::vector<std::filesystem::path> lists_read_with(const std::filesystem::path& path,
                                                                 std::string_view extension);

}  // namespace octetra
