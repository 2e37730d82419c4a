#pragma once

#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/migration.hpp>
#include <octetra/distributed/sharing.hpp>

namespace octetra::distributed {

/// A mesh before its cells moved, or after, in canonical order.
struct SideOfMove {
    const DistributedMesh* mesh = nullptr;
    /// Of each root the process that it goes to, or comes from.
    std::span<const int> rank_of_root;
    /// The number that each cell has when the mesh is not in this order, or empty.
    std::span<const CellIndex> cells_outside{};
};

/// Which cells and vertices go along in messages between partners, for a Migration.
struct MovedEntities {
    std::vector<int> partners;
    Migration::Entities cells;
    Migration::Entities vertices;
};

/// Which cells and vertices went where: both processes of a move know it without asking, as the
/// descendants of a root have the same order on both. A vertex goes along with the cells that have
/// it, but not to a process that has it already: those are `kept`. `sharing` is that of before. Not
/// collective.
[[nodiscard]] MovedEntities moved_entities(const SideOfMove& before, const SideOfMove& after,
                                           const Sharing<VertexIndex>& sharing,
                                           Migration::Message kept);

}  // namespace octetra::distributed
