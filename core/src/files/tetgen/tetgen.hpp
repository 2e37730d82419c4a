#pragma once

#include <filesystem>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh_source.hpp>

#include "files/input/growing_mesh.hpp"

/// TetGen's text files: `.node` (vertices), `.ele` (cells), `.face` (facets), `.edge` (edges).
/// Each begins with a header line of counts; every further line begins with the entity's number.
namespace octetra {

/// Collective in the group of `growing`. Reads the files that belong to `path`. Performs semantic
/// checks unless the options have only_syntax, which a sink and a share require.
void read_tetgen(const std::filesystem::path& path, const ReadOptions& options,
                 GrowingMesh& growing);

/// Collective.
void write_tetgen(MeshSource& mesh, const std::filesystem::path& path);

}  // namespace octetra
