#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/mesh_source.hpp>

namespace octetra {

/// Collective. Writes `NAME.xdmf`, XML that says what is in `NAME.h5`, and this beside it: grids
/// `mesh`, `cell_tags` if there are region tags, `facet_tags` and `edge_tags` if such are listed,
/// as DOLFINx reads them. Both files are put in place, or none. Returns nothing: but for names of
/// groups, all of a mesh is in it.
[[nodiscard]] std::string write_xdmf(MeshSource& mesh, const std::filesystem::path& path);

}  // namespace octetra
