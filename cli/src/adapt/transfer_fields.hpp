#pragma once

#include <string>
#include <vector>

#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/migration.hpp>

namespace octetra::cli {

/// Collective. Transfers the fields of a checkpoint over a step:
///  - on vertices, a midpoint gets the mean of the edge's ends. Integers have no mean: refinement
///    drops such a field;
///  - on cells, each piece gets the value of the cell. A merged cell gets the value of its pieces
///    if all are equal, otherwise their mean, the same on any number of processes. For integers, a
///    field whose pieces differ is dropped.
/// A field is dropped on all processes or on none. Returns a sentence for each reason, with the
/// names of the fields dropped.
[[nodiscard]] std::vector<std::string> transfer_fields(std::vector<distributed::Field>& fields,
                                                       const distributed::Adaptation& step,
                                                       const distributed::Communicator& world);

/// Collective. Moves field values along with migrated cells.
void transfer_fields(std::vector<distributed::Field>& fields, const distributed::Migration& move);

}  // namespace octetra::cli
