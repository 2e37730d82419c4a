#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh_source.hpp>

/// Files of how a refined mesh descends from its input.
namespace octetra {

/// Collective in the mesh's group. Writes how a mesh descends from its input as text, entities
/// numbered as in the mesh's files: a line `cells N`, then N lines "cell parent"; a line
/// `midpoints M`, then M lines "vertex end end". Throws SystemError.
void write_maps(MeshSource& mesh, const std::filesystem::path& path);

/// Reads what write_maps has written, of a mesh whose files count from `index_base`. Only the
/// form is checked: numbers may be of cells and vertices that there are not. Where there are no
/// midpoints, first_midpoint stays 0. Throws InputError or SystemError.
[[nodiscard]] RefinementMaps read_maps(const std::filesystem::path& path, std::uint32_t index_base);

}  // namespace octetra
