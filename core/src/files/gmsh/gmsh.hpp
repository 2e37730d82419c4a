#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_source.hpp>

#include "files/input/growing_mesh.hpp"

/// Gmsh's format `.msh`, versions 2 to 2.2 and 4.1, text and binary: sections `$Name` ...
/// `$EndName`. Nodes have tags, which need not be consecutive; elements belong to entities of the
/// geometry, and these to physical groups, whose tags become markers and region tags.
/// `reading/` parses the sections of a file, `intake/` builds a mesh from their nodes and elements,
/// and `writing/` writes a mesh.
namespace octetra {

/// Collective in the group of `growing`, within a transaction if it has several processes. Reads a
/// mesh. Performs semantic checks unless the options have only_syntax, which a sink and a share
/// require. For a sink, reads the file twice, because elements of all kinds are counted together,
/// but a sink must know the number of each kind in advance.
void read_gmsh(const std::filesystem::path& path, const ReadOptions& options, GrowingMesh& growing);

/// Collective. The tag of an element is its position in the file. There is an entity for each
/// marker of a kind, and a block for each run of elements with the same entity, so the order of the
/// elements is preserved. Returns a sentence naming the data that the format cannot hold, or an
/// empty string.
[[nodiscard]] std::string write_gmsh(MeshSource& mesh, const std::filesystem::path& path,
                                     const MshFormat& format);

}  // namespace octetra
