#pragma once

#include <span>
#include <vector>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. The fields of a checkpoint, on this process's part of its mesh. That is in canonical
/// order; `cells_before` are the numbers by which the cells' values are to go, if not by this
/// order.
[[nodiscard]] std::vector<Field> load_fields(const DistributedMesh& mesh,
                                             std::span<const CellIndex> cells_before,
                                             const CanonicalNumbers& numbers,
                                             const CheckpointReader& file);

}  // namespace octetra::distributed
