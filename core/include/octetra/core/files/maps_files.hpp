#pragma once

#include <cstdint>
#include <filesystem>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh_source.hpp>

/// Files of refinement maps: the parents of cells and the edges of midpoints.
namespace octetra {

/// Collective in the mesh's group. Writes the parents of cells and the ends of bisected edges as
/// text, with entities numbered as in the mesh's files: a line `cells N`, then N lines "cell
/// parent"; a line `midpoints M`, then M lines "vertex end end". Throws SystemError.
void write_maps(MeshSource& mesh, const std::filesystem::path& path);

/// Reads a file written by write_maps(), for a mesh whose files count from `index_base`. Checks
/// only the syntax: numbers may be out of range for the mesh. Without midpoints, first_midpoint
/// stays 0. Throws InputError or SystemError.
[[nodiscard]] RefinementMaps read_maps(const std::filesystem::path& path, std::uint32_t index_base);

}  // namespace octetra
