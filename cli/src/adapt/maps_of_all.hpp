#pragma once

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::cli {

/// Collective. Returns the complete maps on every process. Needed only for --maps.
[[nodiscard]] RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world);

}  // namespace octetra::cli
