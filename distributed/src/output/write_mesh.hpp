#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// Collective. Writes the mesh with fields; see AdaptiveMesh::write().
[[nodiscard]] std::string write_mesh(const DistributedMesh& mesh,
                                     const Sharing<VertexIndex>& sharing,
                                     std::span<const Field> fields,
                                     const std::filesystem::path& path,
                                     const WriteOptions& options);

}  // namespace octetra::distributed
