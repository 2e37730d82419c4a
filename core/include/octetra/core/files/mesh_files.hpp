#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

/// Mesh files, by extension: TetGen `.node/.ele` (with `.face` and `.edge` if present), Medit
/// `.mesh` and `.meshb`, Gmsh `.msh`. VTK `.vtu`, `.pvtu` and `.vtkhdf`, and XDMF `.xdmf` with its
/// `.h5`, can only be written.
namespace octetra {

struct ReadOptions {
    /// Reverse inverted cells, by exchanging their last two corners, instead of throwing.
    bool fix_orientation = false;
    /// Do not check cells, facets and edges: cells may be inverted, flat, repeated or have a
    /// repeated vertex; facets and edges may belong to no cell or have two markers. Intended for
    /// the verifier. Vertex numbers are still checked to be in range, and coordinates to be finite.
    bool only_syntax = false;
    /// Called with a sentence for content of the file that the mesh does not hold (Medit's
    /// `Normals`, for example), and for the number of reversed cells.
    std::function<void(const std::string&)> note = [](const std::string&) {};
};

/// Variant of the `.msh` format to write: version 4.1 or 2.2, binary or text.
struct MshFormat {
    bool is_2 = false;
    bool is_text = false;
};

struct WriteOptions {
    MshFormat msh;
};

/// Reads and checks a mesh. The result satisfies the invariants of struct Mesh; with
/// ReadOptions::only_syntax, only the first of them, and vertices of an entity may repeat. For
/// TetGen, `path` names the `.ele` or the `.node` file; both must exist. Throws InputError
/// ("FILE:LINE: what is wrong", for a binary file "FILE: at byte N: ...") or SystemError.
/// Memory in addition to the mesh: a buffer of 1 MiB, 2 bytes per cell while reading cells, and 8
/// bytes per vertex while checking facets; for a Gmsh file whose node tags are not consecutive, up
/// to 32 bytes per vertex.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh and passes it to the sink in batches. Performs the checks of read_mesh() with
/// ReadOptions::only_syntax and throws the same errors. Only the option `note` is used. Memory,
/// independent of the size of the mesh: a buffer of 1 MiB and one batch of each kind; twice that
/// for a Medit text file in which Vertices follow sections that refer to them, which is read twice.
/// A Gmsh file is also read twice, and needs the memory for node tags that read_mesh() needs.
void stream_mesh(const std::filesystem::path& path, MeshSink& sink,
                 const ReadOptions& options = {});

/// Collective in the mesh's group. Writes a mesh such that reading it returns the same bits; the
/// file does not depend on the number of processes. For TetGen, `path` names the `.ele` or the
/// `.node` file; `.face` and `.edge` are written if the mesh has facets and edges, otherwise
/// existing ones are removed. Symbolic links are followed, and existing files keep their
/// permissions. Fields of a Medit mesh are written to a separate file next to it. `.vtu`, `.vtkhdf`
/// and `.xdmf` files contain the parents as cell data. Binary `.msh` files of version 2.2 hold at
/// most 2^31 - 1 nodes and elements; a larger mesh causes an InputError. No file is renamed to its
/// final name before all are complete; if writing fails, none is. Throws InputError for an unknown
/// extension, otherwise SystemError. Returns a sentence naming the data that this format cannot
/// hold, or an empty string.
[[nodiscard]] std::string write_mesh(MeshSource& mesh, const std::filesystem::path& path,
                                     const WriteOptions& options = {});

/// As above, for a mesh held entirely by this process.
[[nodiscard]] std::string write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                                     const WriteOptions& options = {});

/// Returns whether files with this extension can hold attributes of vertices.
[[nodiscard]] bool can_hold_attributes(const std::filesystem::path& path);

/// Returns whether files with this extension can hold markers of vertices.
[[nodiscard]] bool can_hold_vertex_markers(const std::filesystem::path& path);

/// Returns whether mesh files with this extension can hold fields. (Checkpoints, which are written
/// by other functions, can; those of a Medit mesh are in a separate file, see sol_files.hpp.)
[[nodiscard]] bool can_hold_fields(const std::filesystem::path& path);

/// Returns whether the file (`.pvtu`) refers to pieces, one for each process, instead of containing
/// the mesh.
[[nodiscard]] bool is_in_pieces(const std::filesystem::path& path);

/// Collective in the group. Each process writes its own piece, in its own order and numbering; the
/// `.pvtu` file `path` refers to the pieces. Otherwise as write_mesh().
[[nodiscard]] std::string write_pieces(MeshSource& piece, const ProcessGroup& group,
                                       const std::filesystem::path& path);

}  // namespace octetra
