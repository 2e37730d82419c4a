#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

/// Gmsh's format `.msh`, versions 2 to 2.2 and 4.1, text and binary: sections `$Name` ...
/// `$EndName`. Nodes have tags, which need not be consecutive; elements belong to entities of the
/// geometry, and these to physical groups, whose tags are our markers and region tags.
namespace octetra {

[[nodiscard]] Mesh read_gmsh(const std::filesystem::path& path, const ReadOptions& options);

/// Takes everything as it stands; `options` must have only_syntax. Reads the file twice: elements
/// of all kinds are counted together, and a sink is to know how many of each will come.
void stream_gmsh(const std::filesystem::path& path, MeshSink& sink, const ReadOptions& options);

/// Collective. An element has the tag of its place in the file; there is an entity for each marker
/// of a kind, and a block for each run of elements of one, so that all keep their order. Returns
/// what of the mesh the format cannot hold, in a sentence, or nothing.
[[nodiscard]] std::string write_gmsh(MeshSource& mesh, const std::filesystem::path& path,
                                     const MshFormat& format);

}  // namespace octetra
