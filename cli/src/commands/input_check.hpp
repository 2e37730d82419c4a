#pragma once

#include <string>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/verify/mesh_slice.hpp>

namespace octetra::cli {

/// Collective. All processes judge the mesh, which the first one has read from `path`, as
/// `octetra verify` does. If it is not valid, says why on stdout, and throws InputError on all.
void check_input(const Mesh& mesh, const std::string& path, const distributed::Communicator& world);

/// Collective. The same of a mesh in parts, or in slices.
void check_input(const distributed::DistributedMesh& parts, const std::string& path);
void check_input(verify::MeshSlice mesh, const std::string& path,
                 const distributed::Communicator& world);

/// Collective. The slices of a mesh in parts.
[[nodiscard]] verify::MeshSlice slice_of(const distributed::DistributedMesh& parts);

}  // namespace octetra::cli
