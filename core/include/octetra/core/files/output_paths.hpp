#pragma once

#include <filesystem>
#include <vector>

/// Paths of a mesh: its files, the targets of links, and whether they can be written.
namespace octetra {

/// Returns the files that form a mesh of this name, whether they exist or not: `.node`, `.ele`,
/// `.face` and `.edge` for TetGen, `.xdmf` and `.h5` for XDMF, otherwise `path` itself.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path);

/// Returns the files that writing a mesh to `path` replaces or removes: the files of the mesh; for
/// a `.pvtu`, its pieces, including those of a previous mesh; for TetGen, also the `.face` and
/// `.edge` files next to the targets of links at `.node` and `.ele`.
[[nodiscard]] std::vector<std::filesystem::path> files_to_write(const std::filesystem::path& path,
                                                                int pieces = 1);

/// Returns the final path of a file written to `path`: symbolic links are followed, also to files
/// that do not exist yet.
[[nodiscard]] std::filesystem::path resolved_path(const std::filesystem::path& path);

/// Returns whether files written to `a` and `b` would be the same file.
[[nodiscard]] bool refer_to_same_file(const std::filesystem::path& a,
                                      const std::filesystem::path& b);

/// Throws InputError unless `path` has an extension that can be written, check_output_path()
/// accepts all its files, and their final paths are distinct. Allows an error to be reported before
/// the computation.
void check_writable(const std::filesystem::path& path, int pieces = 1);

/// Throws InputError unless a file can be written to `path`, or to the target of a link there: the
/// folder must be writable, and an existing entry must be a writable regular file.
void check_output_path(const std::filesystem::path& path);

}  // namespace octetra
