#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

#include "pattern/length_order.hpp"

namespace octetra::distributed {

/// Cache of the orders of cells' edges by length; each is computed at its first use. Keeps a
/// pointer to the mesh, whose cells must not change. Memory: 2 bytes per cell.
class CellOrders {
public:
    explicit CellOrders(const DistributedMesh& mesh)
        : mesh_(&mesh), known_(mesh.cells.size(), unknown) {}

    [[nodiscard]] CellIndex end_index() const { return known_.end_index(); }
    [[nodiscard]] LengthOrder of(CellIndex cell) {
        LengthOrder& order = known_[cell];
        if (order == unknown) order = length_order(mesh_->points, mesh_->cells[cell]);
        return order;
    }

private:
    static constexpr LengthOrder unknown = order_count;

    const DistributedMesh* mesh_;
    IndexVector<CellIndex, LengthOrder> known_;
};

}  // namespace octetra::distributed
