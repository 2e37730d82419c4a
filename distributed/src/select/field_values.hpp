#pragma once

#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "select/select_cells.hpp"

namespace octetra::distributed {

/// Returns the field with the name of the term; one on cells precedes one on vertices. Throws
/// InputError if there is none.
[[nodiscard]] const Field& find_field(const Term& term, std::span<const Field> fields);

/// Returns the mean over the vertices of each cell of this process.
[[nodiscard]] std::vector<double> means_of(const DistributedMesh& mesh,
                                           std::span<const double> of_vertex);

/// Collective, within a transaction. Returns the values of a term that needs a field, one for each
/// cell of this process. Throws InputError if there is no such field.
[[nodiscard]] std::vector<double> field_values(const DistributedMesh& mesh, const Term& term,
                                               const FieldsToUse& fields);

}  // namespace octetra::distributed
