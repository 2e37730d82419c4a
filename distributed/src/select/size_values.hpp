#pragma once

#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "select/select_cells.hpp"

namespace octetra::distributed {

/// Collective, within a transaction. Returns the values of a term metric_longest() or size(), one
/// for each cell of this process. Throws InputError if there is no such field, if it has a number
/// of components other than 1 (a size) and 6 (a metric), and for the vertex or cell with the lowest
/// number whose size is not above 0 or whose metric is not positive definite.
[[nodiscard]] std::vector<double> size_values(const DistributedMesh& mesh, const Term& term,
                                              const FieldsToUse& fields);

}  // namespace octetra::distributed
