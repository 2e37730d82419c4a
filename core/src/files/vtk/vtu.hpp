#pragma once

#include <filesystem>
#include <string>

#include <octetra/core/mesh_source.hpp>

#include "files/output/output_file.hpp"
#include "files/vtk/vtu_arrays.hpp"

/// VTK's formats for unstructured grids: XML and HDF5.
namespace octetra {

/// Collective. Writes one file `.vtu`: one piece of tetrahedra, arrays appended in binary and
/// compressed by zlib; region tags as cell data `region`, parents as `parent`, vertex markers as
/// point data `marker`, vertex attributes as `attributes`.
/// Returns what of the mesh the file does not hold, in a sentence, or nothing.
[[nodiscard]] std::string write_vtu(MeshSource& mesh, const std::filesystem::path& path);

/// Collective. Writes one file `.vtkhdf`, an HDF5 file of VTK's: the same arrays under the same
/// names, not compressed, so that each process knows where its own values belong.
/// Returns what of the mesh the file does not hold, in a sentence, or nothing.
[[nodiscard]] std::string write_vtkhdf(MeshSource& mesh, const std::filesystem::path& path);

/// Collective in the group; the piece is this process's own. Writes its piece as a file of its own,
/// `NAME_RANK.vtu` beside `NAME.pvtu`, which names them all; cells carry the `rank` of their piece
/// too, and points their number in the whole mesh, `vertex`.
/// Returns what of the mesh the files do not hold, in a sentence, or nothing.
[[nodiscard]] std::string write_pvtu(MeshSource& piece, const ProcessGroup& group,
                                     const std::filesystem::path& path);

/// What a file that holds cells only does not hold of these lists, in a sentence, or nothing.
[[nodiscard]] std::string lists_left_out(const std::filesystem::path& path, std::uint64_t facets,
                                         std::uint64_t edges);

/// Collective in the mesh's group. Everything of a .vtu file, not yet committed.
void put_vtu(OutputFile& out, MeshSource& mesh, const VtuData& data);

}  // namespace octetra
