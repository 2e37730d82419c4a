#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/distributed/balance.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "comm/local_failure.hpp"
#include "history/cells_as_roots.hpp"
#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// Collective. Where each root of this process is to go, of a mesh in canonical order; nothing, on
/// all processes, where the one that has most would not have less. Where roots are too heavy for
/// what `balance` wants, and it allows that, cells become roots as long as `roots` lives. `weigh`
/// tells the weights of the roots that there are. `known`: see CellsAsRoots. Throws alike.
[[nodiscard]] std::optional<std::vector<int>> even_parts_or_roots(
    DistributedMesh& mesh, const std::function<std::vector<std::uint64_t>()>& weigh,
    const BalanceOptions& balance, std::unique_ptr<CellsAsRoots>& roots,
    const CanonicalNumbers* known, LocalFailure& failure);

}  // namespace octetra::distributed
