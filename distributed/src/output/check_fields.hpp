#pragma once

#include <span>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>

namespace octetra::distributed {

/// Throws InputError for fields that do not match this process's part, or that a checkpoint's table
/// cannot represent. Not collective.
void check_sizes(const DistributedMesh& mesh, std::span<const Field> fields);

/// Collective. Throws InputError if the fields of a process differ from those of the first one.
void check_same(const Communicator& processes, std::span<const Field> fields);

[[nodiscard]] FieldFacts facts_of(const Field& field);

}  // namespace octetra::distributed
