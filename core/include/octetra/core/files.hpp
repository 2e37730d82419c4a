#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_sink.hpp>
#include <octetra/core/mesh_source.hpp>

/// Mesh files, by extension: TetGen `.node/.ele` (with `.face`, `.edge` beside them where present),
/// Medit `.mesh`; VTK `.vtu` and `.pvtu` are written only.
namespace octetra {

struct ReadOptions {
    /// Turn inverted cells round, by exchanging their last two corners, rather than refuse them.
    bool fix_orientation = false;
    /// Take cells, facets and edges as they stand: cells may be inverted, flat, there twice or have
    /// a vertex twice, facets and edges may belong to no cell or have two markers. For whoever
    /// judges the mesh; vertex numbers are still in range and coordinates finite.
    bool only_syntax = false;
    /// Told, in a sentence, of what is in the file but not in the mesh (Medit's `Corners`, say),
    /// and of how many cells were turned round.
    std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Reads and checks a mesh; what holds afterwards is written at struct Mesh
/// (and with ReadOptions::only_syntax, the first line of it but for repeated vertices).
/// For TetGen, `path` names the `.ele` or the `.node` file; both must be there.
/// Throws InputError ("FILE:LINE: what is wrong") or SystemError.
/// Memory beyond the mesh: a buffer of 1 MiB, 2 bytes per cell while cells are read, and 8 bytes
/// per vertex while facets are checked.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh and tells the sink of it, stretch by stretch; checks what read_mesh does with
/// ReadOptions::only_syntax, and throws the same. Of the options only `note` is looked at.
/// Memory, however large the mesh: a buffer of 1 MiB and a stretch of each kind; twice that for a
/// Medit file in which Vertices stand behind what refers to them, which is read twice.
void stream_mesh(const std::filesystem::path& path, MeshSink& sink,
                 const ReadOptions& options = {});

/// Collective in the mesh's group. Writes a mesh so that it reads back to the same bits, which do
/// not depend on the number of processes. For TetGen, `path` names the `.ele` or the `.node` file,
/// and `.face`, `.edge` are written (or removed, if they are there from before) as the mesh has
/// facets and edges. Links are followed, and files that are there keep their permissions. Of maps,
/// `.vtu` carries the parents, as cell data. All files are complete before the first takes its
/// final name; where writing fails, none does. Throws InputError for an unknown extension, else
/// SystemError. Returns what of the mesh this format cannot hold, in a sentence, or nothing.
[[nodiscard]] std::string write_mesh(MeshSource& mesh, const std::filesystem::path& path);

/// The same of a mesh that this process has all of.
[[nodiscard]] std::string write_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// Can files with this extension hold attributes of vertices?
[[nodiscard]] bool can_hold_attributes(const std::filesystem::path& path);

/// Does this file name pieces, one for each process, rather than holding the mesh? (`.pvtu`)
[[nodiscard]] bool is_in_pieces(const std::filesystem::path& path);

/// Collective in the group. Writes a mesh of which each process has a piece, in its own order and
/// with its own numbers, as pieces that `path`, a `.pvtu`, then names. As write_mesh else.
[[nodiscard]] std::string write_pieces(MeshSource& piece, const ProcessGroup& group,
                                       const std::filesystem::path& path);

/// Collective in the mesh's group. Writes how a mesh descends from its input as text, entities
/// numbered as in the mesh's files: a line `cells N`, then N lines "cell parent"; a line
/// `midpoints M`, then M lines "vertex end end". Throws SystemError.
void write_maps(MeshSource& mesh, const std::filesystem::path& path);

/// The files that a mesh of this name is, be they there or not: `.node`, `.ele`, `.face` and
/// `.edge` for TetGen, else `path` itself.
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

/// Writes numbers as text, a line each. Throws SystemError.
void write_list(const std::vector<int>& numbers, const std::filesystem::path& path);

/// Writes text, beside its final name and then renamed as all files are. Throws SystemError.
void write_text(std::string_view text, const std::filesystem::path& path);

/// Removes the temporary files of everything that is being written at the moment. For a signal
/// handler that ends the program: it calls nothing but unlink().
void remove_unfinished_files() noexcept;

/// Reads a list of cell numbers, separated by blanks or line ends, `#` starting a comment, that
/// count from `first_number` and are less than `cell_count` + `first_number`.
/// Returns them ascending, each once, counted from 0. Throws InputError or SystemError.
[[nodiscard]] std::vector<GlobalCell> read_cell_list(const std::filesystem::path& path,
                                                     std::uint32_t first_number,
                                                     std::size_t cell_count);

}  // namespace octetra
