#pragma once

#include <span>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/field.hpp>

namespace octetra::distributed {

/// Not collective. Throws InputError for fields that do not fit this process's part, or that a
/// checkpoint's table could not tell of.
void check_sizes(const DistributedMesh& mesh, std::span<const Field> fields);

/// Collective. Throws InputError where processes have other fields than the first one has.
void check_same(const Communicator& processes, std::span<const Field> fields);

[[nodiscard]] FieldFacts facts_of(const Field& field);

}  // namespace octetra::distributed
