#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/mesh_source.hpp>

#include "files/output/output_file.hpp"
#include "files/output/vtk_arrays.hpp"

/// VTK formats for unstructured grids: XML and HDF5.
namespace octetra {

/// Collective. Writes a single `.vtu` file: one piece of tetrahedra, with arrays appended in binary
/// and compressed by zlib; region tags as cell data `region`, parents as `parent`, vertex markers
/// as point data `marker`, vertex attributes as `attributes`.
/// Returns a sentence naming the data that the file does not hold, or an empty string.
[[nodiscard]] std::string write_vtu(MeshSource& mesh, const std::filesystem::path& path);

/// Collective. Writes a single `.vtkhdf` file, in VTK's HDF5 format: the same arrays with the same
/// names, uncompressed, so that each process knows the position of its own values.
/// Returns a sentence naming the data that the file does not hold, or an empty string.
[[nodiscard]] std::string write_vtkhdf(MeshSource& mesh, const std::filesystem::path& path);

/// Collective in the group; `piece` is held by this process alone. Writes the piece to
/// `NAME_RANK.vtu` and, on the first process, `NAME.pvtu`, which refers to all pieces. Cells also
/// have the `rank` of their piece, points their global number `vertex`.
/// Returns a sentence naming the data that the files do not hold, or an empty string.
[[nodiscard]] std::string write_pvtu(MeshSource& piece, const ProcessGroup& group,
                                     const std::filesystem::path& path);

/// Returns a sentence naming the lists that a file of cells alone does not hold, or an empty
/// string.
[[nodiscard]] std::string lists_left_out(const std::filesystem::path& path, std::uint64_t facets,
                                         std::uint64_t edges);

/// Collective in the mesh's group. Writes the contents of a .vtu file without committing it.
void put_vtu(OutputFile& out, MeshSource& mesh, const VtuData& data);

}  // namespace octetra
