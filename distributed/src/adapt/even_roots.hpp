#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "history/cells_as_roots.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Returns the destination rank of each root of this process; nothing, on all
/// processes, if the maximum load would not decrease. The mesh must be in canonical order. If roots
/// are too heavy for `balance`, and it permits it, cells become roots while `roots` exists. `weigh`
/// returns the weights of the current roots. For `known` see CellsAsRoots.
[[nodiscard]] std::optional<std::vector<int>> even_parts_or_roots(
    DistributedMesh& mesh, const std::function<std::vector<std::uint64_t>()>& weigh,
    const BalanceOptions& balance, std::unique_ptr<CellsAsRoots>& roots,
    const CanonicalNumbers* known);

}  // namespace octetra::distributed
