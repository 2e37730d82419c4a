#pragma once

#include <filesystem>
#include <memory>

#include <octetra/core/mesh_source.hpp>

#include "files/output/output_file.hpp"

namespace octetra {

/// Collective. Writes the fields that such a file can hold: those of vertices, then those of cells,
/// each in their order.
void put_sol(OutputFile& out, MeshSource& mesh, bool is_binary);

/// Collective. Puts a Medit mesh in its place and, where it has fields that a file of values can
/// hold, that file beside it: both, or none.
void commit_with_fields(std::unique_ptr<OutputFile> file, MeshSource& mesh,
                        const std::filesystem::path& path);

}  // namespace octetra
