#pragma once

#include <span>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/background.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Returns for each cell of this process the value of the
/// background that the term names at the centroid or, outside the background mesh, at its closest
/// point. Of several background cells at this point, the one with the least value counts. No
/// process gets the background cells of others: a process sends a centroid to those that may have a
/// closer cell than its own. Throws InputError if there is no such background.
[[nodiscard]] std::vector<double> background_values(const DistributedMesh& mesh, const Term& term,
                                                    std::span<const Background> backgrounds);

}  // namespace octetra::distributed
