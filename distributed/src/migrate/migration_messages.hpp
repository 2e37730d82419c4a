#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/migration.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// A mesh before or after a migration, in canonical order.
struct SideOfMove {
    const DistributedMesh* mesh = nullptr;
    /// For each root, the process that it moves to, or is received from.
    std::span<const int> rank_of_root;
    /// Maps canonical to actual indices of the cells if the mesh is not in canonical order; else
    /// empty.
    std::span<const CellIndex> unordered_cell_ids{};
};

/// The cells and vertices in the messages between partners, for a Migration.
struct MovedEntities {
    std::vector<int> partners;
    Migration::Entities cells;
    Migration::Entities vertices;
};

/// Determines the messages of a migration. Both processes of a move compute them without
/// communication, because the descendants of a root have the same order on both. A vertex is sent
/// with the cells that have it, except to processes that have it already: there it is one of
/// `kept`. `sharing` is that before the migration. Not collective.
[[nodiscard]] MovedEntities moved_entities(const SideOfMove& before, const SideOfMove& after,
                                           const Sharing<VertexIndex>& sharing,
                                           Migration::Message kept);

}  // namespace octetra::distributed
