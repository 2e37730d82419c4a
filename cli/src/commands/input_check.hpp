#pragma once

#include <string>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/verify/mesh_slice.hpp>

namespace octetra::cli {

/// Collective. Verifies the mesh, which the first process has read from `path`, on all processes,
/// as `octetra verify` does. If it is not valid, prints the reason to stdout and throws InputError
/// on all.
void check_input(const Mesh& mesh, const std::string& path, const distributed::Communicator& world);

/// Collective. As above, for a mesh in parts or slices.
void check_input(const distributed::DistributedMesh& parts, const std::string& path);
void check_input(verify::MeshSlice mesh, const std::string& path,
                 const distributed::Communicator& world);

/// Collective. Returns the slices of a mesh in parts.
[[nodiscard]] verify::MeshSlice slice_of(const distributed::DistributedMesh& parts);

}  // namespace octetra::cli
