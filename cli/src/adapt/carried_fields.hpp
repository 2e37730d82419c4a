#pragma once

#include <string>
#include <vector>

#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/field.hpp>
#include <octetra/distributed/migration.hpp>

namespace octetra::cli {

/// Collective. Carries the fields of a checkpoint over a step:
///  - on vertices, to a midpoint the mean of the edge's ends. Whole numbers have none: such a field
///    is dropped by a step of refinement;
///  - on cells, to each piece of a cell its value. Pieces that become one give it their value where
///    all have the same, else their mean, the same on any number of processes. Of whole numbers
///    there is no mean: a field where such pieces differ is dropped.
/// What is dropped is dropped on all processes. Returns the names of those fields and why, in a
/// sentence each; nothing if all were carried.
[[nodiscard]] std::vector<std::string> carry_fields(std::vector<distributed::Field>& fields,
                                                    const distributed::Adaptation& step,
                                                    const distributed::Communicator& world);

/// Collective. Brings the fields along with cells that went to other processes.
void carry_fields(std::vector<distributed::Field>& fields, const distributed::Migration& move);

}  // namespace octetra::cli
