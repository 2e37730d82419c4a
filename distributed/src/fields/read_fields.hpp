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

/// Collective. Returns the fields of a Medit file on this process's part of a mesh in canonical
/// order; see AdaptiveMesh::read_fields(). If the values of cells are to be in another order,
/// `cells_before` maps canonical local indices to it; otherwise it is empty.
[[nodiscard]] std::vector<Field> read_fields(const DistributedMesh& mesh,
                                             std::span<const CellIndex> cells_before,
                                             const CanonicalNumbers& numbers,
                                             const std::filesystem::path& path,
                                             const std::function<void(const std::string&)>& note);

}  // namespace octetra::distributed
