#pragma once

#include <filesystem>
#include <vector>

/// Which files a mesh is, where a file stands in the end, and whether it can be put there.
namespace octetra {

/// The files that a mesh of this name is, whether they exist or not: `.node`, `.ele`, `.face` and
/// `.edge` for TetGen, `.xdmf` and `.h5` for XDMF, else `path` itself.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

/// The files that writing a mesh at `path` replaces or removes: its own; for a `.pvtu` its pieces,
/// those of an older mesh included; for TetGen also lists beside what links to `.node` and `.ele`
/// lead to.
[[nodiscard]] std::vector<std::filesystem::path> files_to_write(const std::filesystem::path& path,
                                                                int pieces = 1);

/// Where a file written at `path` stands in the end: links are followed, to where there need not
/// be a file yet.
[[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& path);

/// Would files written at `a` and `b` be one?
[[nodiscard]] bool are_one_place(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws InputError unless `path` has an extension that can be written and its files stand where
/// check_place lets them, each in a place of its own. (To refuse before the work, not after it.)
void check_writable(const std::filesystem::path& path, int pieces = 1);

/// Throws InputError unless a file can be put at `path`, or where the link there leads: in a folder
/// that is writable, and in place of nothing but a file that is writable, too.
void check_place(const std::filesystem::path& path);

}  // namespace octetra
