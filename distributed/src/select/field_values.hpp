#pragma once

#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "select/select_cells.hpp"

namespace octetra::distributed {

/// Collective, within a transaction. Returns the values of a term that needs a field, one for each
/// cell of this process. Throws InputError if there is no such field.
[[nodiscard]] std::vector<double> field_values(const DistributedMesh& mesh, const Term& term,
                                               const FieldsToUse& fields);

}  // namespace octetra::distributed
