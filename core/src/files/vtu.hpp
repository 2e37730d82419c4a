#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/files.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra {

/// Writes VTK's XML format for unstructured grids: one piece of tetrahedra, arrays appended in
/// binary and compressed by zlib; region tags as cell data `region`, parents as `parent`, vertex
/// markers as point data `marker`, vertex attributes as `attributes`.
/// Returns what of the mesh the file does not hold, in a sentence, or nothing.
[[nodiscard]] std::string write_vtu(const Mesh& mesh, const std::filesystem::path& path,
                                    const WriteExtras& extras);

}  // namespace octetra
