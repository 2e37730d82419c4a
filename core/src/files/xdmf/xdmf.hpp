#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/mesh_source.hpp>

namespace octetra {

/// Collective. Writes `NAME.xdmf`, the XML description of `NAME.h5`, and this file next to it:
/// grids `mesh`, `cell_tags` if there are region tags, `facet_tags` and `edge_tags` if there are
/// tagged facets and edges, as DOLFINx reads them. Both files are written, or neither. Returns an
/// empty string: the files hold everything except group names and features, which write_mesh()
/// reports.
[[nodiscard]] std::string write_xdmf(MeshSource& mesh, const std::filesystem::path& path);

}  // namespace octetra
