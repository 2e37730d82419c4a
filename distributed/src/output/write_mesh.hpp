#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/files/series.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Writes the mesh with fields; see AdaptiveMesh::write(). `numbers` and `sharing` are
/// those of its vertices.
[[nodiscard]] std::string write_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                     const Sharing<VertexIndex>& sharing,
                                     std::span<const Field> fields,
                                     const std::filesystem::path& path,
                                     const WriteOptions& options);

/// Collective. Appends the mesh with fields to a series; see AdaptiveMesh::append_to().
void append_mesh(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                 const Sharing<VertexIndex>& sharing, std::span<const Field> fields,
                 MeshSeries& series, double time);

}  // namespace octetra::distributed
