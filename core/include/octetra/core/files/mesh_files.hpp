#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

/// Mesh files, by extension: TetGen `.node/.ele` (with `.face`, `.edge` beside them where present),
/// Medit `.mesh` and `.meshb`, Gmsh `.msh`; VTK `.vtu`, `.pvtu` and `.vtkhdf`, and XDMF
/// `.xdmf` with the `.h5` beside it, are written only.
namespace octetra {

struct ReadOptions {
    /// Turn inverted cells round, by exchanging their last two corners, rather than refuse them.
    bool fix_orientation = false;
    /// Take cells, facets and edges as they stand: cells may be inverted, flat, there twice or have
    /// a vertex twice, facets and edges may belong to no cell or have two markers. For whoever
    /// judges the mesh; vertex numbers are still in range and coordinates finite.
    bool only_syntax = false;
    /// Told, in a sentence, of what is in the file but not in the mesh (Medit's `Normals`, say),
    /// and of how many cells were turned round.
    std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Which of its kinds a `.msh` file is to be: version 4.1 or 2.2, binary or text.
struct MshFormat {
    bool is_2 = false;
    bool is_text = false;
};

struct WriteOptions {
    MshFormat msh;
};

/// Reads and checks a mesh; what holds afterwards is written at struct Mesh
/// (and with ReadOptions::only_syntax, the first line of it but for repeated vertices).
/// For TetGen, `path` names the `.ele` or the `.node` file; both must be there.
/// Throws InputError ("FILE:LINE: what is wrong", of a binary file "FILE: at byte N: ...") or
/// SystemError.
/// Memory beyond the mesh: a buffer of 1 MiB, 2 bytes per cell while cells are read, and 8 bytes
/// per vertex while facets are checked; for a Gmsh file whose nodes are not numbered one after the
/// other up to 32 bytes per vertex.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh and tells the sink of it, stretch by stretch; checks what read_mesh does with
/// ReadOptions::only_syntax, and throws the same. Of the options only `note` is looked at.
/// Memory, however large the mesh: a buffer of 1 MiB and a stretch of each kind; twice that for a
/// Medit text file in which Vertices stand behind what refers to them, which is read twice. A Gmsh
/// file is read twice, too, and takes memory for its nodes' tags where read_mesh() does.
void stream_mesh(const std::filesystem::path& path, MeshSink& sink,
                 const ReadOptions& options = {});

/// Collective in the mesh's group. Writes a mesh so that it reads back to the same bits, which do
/// not depend on the number of processes. For TetGen, `path` names the `.ele` or the `.node` file,
/// and `.face`, `.edge` are written (or removed, if they are there from before) as the mesh has
/// facets and edges. Links are followed, and files that are there keep their permissions. Fields
/// of a Medit mesh go into a file beside it. Of maps, `.vtu`, `.vtkhdf` and `.xdmf` carry the
/// parents, as cell data. Binary `.msh` files of version 2.2 hold at most 2^31 - 1 nodes and
/// elements; others are refused, by an InputError. All files are complete before the first takes
/// its final name; where writing fails, none does. Throws InputError for an unknown extension, else
/// SystemError. Returns what of the mesh this format cannot hold, in a sentence, or nothing.
[[nodiscard]] std::string write_mesh(MeshSource& mesh, const std::filesystem::path& path,
                                     const WriteOptions& options = {});

/// The same of a mesh that this process has all of.
[[nodiscard]] std::string write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                                     const WriteOptions& options = {});

/// Can files with this extension hold attributes of vertices?
[[nodiscard]] bool can_hold_attributes(const std::filesystem::path& path);

/// Can files with this extension hold markers of vertices?
[[nodiscard]] bool can_hold_vertex_markers(const std::filesystem::path& path);

/// Can mesh files with this extension hold fields? (Checkpoints, which are written otherwise, can;
/// those of a Medit mesh go into a file beside it, see sol_files.hpp.)
[[nodiscard]] bool can_hold_fields(const std::filesystem::path& path);

/// Does this file name pieces, one for each process, rather than holding the mesh? (`.pvtu`)
[[nodiscard]] bool is_in_pieces(const std::filesystem::path& path);

/// Collective in the group. Writes a mesh of which each process has a piece, in its own order and
/// with its own numbers, as pieces that `path`, a `.pvtu`, then names. As write_mesh else.
[[nodiscard]] std::string write_pieces(MeshSource& piece, const ProcessGroup& group,
                                       const std::filesystem::path& path);

}  // namespace octetra
