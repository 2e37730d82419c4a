#pragma once

#include <filesystem>
#include <memory>

#include <octetra/core/mesh_source.hpp>

#include "files/output/output_file.hpp"

namespace octetra {

/// Collective. Writes the fields that a solution file can hold: those of vertices, then those of
/// cells, each in order.
void write_sol_contents(OutputFile& out, MeshSource& mesh, bool is_binary);

/// Collective. Writes a Medit mesh to its final path and, if it has fields that a solution file can
/// hold, also that file next to it: both files, or neither.
void commit_with_fields(std::unique_ptr<OutputFile> file, MeshSource& mesh,
                        const std::filesystem::path& path);

}  // namespace octetra
