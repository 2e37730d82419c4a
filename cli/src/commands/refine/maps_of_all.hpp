#pragma once

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::cli {

/// Collective. Every process gets the whole of the maps. (Only who asks for --maps needs them.)
[[nodiscard]] RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world);

}  // namespace octetra::cli
