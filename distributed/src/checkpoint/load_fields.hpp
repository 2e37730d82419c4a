#pragma once

#include <span>
#include <vector>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Returns the fields of a checkpoint on this process's part of its mesh, which is in
/// canonical order. If the values of cells are to be in another order, `cells_before` maps
/// canonical local indices to it; otherwise it is empty.
[[nodiscard]] std::vector<Field> load_fields(const DistributedMesh& mesh,
                                             std::span<const CellIndex> cells_before,
                                             const CanonicalNumbers& numbers,
                                             const CheckpointReader& file);

}  // namespace octetra::distributed
