#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. The fields of a file of Medit's on this process's part of a mesh in canonical order;
/// see AdaptiveMesh::read_fields(). `cells_before` are the numbers by which the cells' values are
/// to go, if not by this order.
[[nodiscard]] std::vector<Field> read_fields(const DistributedMesh& mesh,
                                             std::span<const CellIndex> cells_before,
                                             const CanonicalNumbers& numbers,
                                             const std::filesystem::path& path,
                                             const std::function<void(const std::string&)>& note);

}  // namespace octetra::distributed
