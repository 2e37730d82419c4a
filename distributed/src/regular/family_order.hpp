#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "level/made_change.hpp"
#include "level/transition_cells.hpp"
#include "pattern/patterns.hpp"
#include "regular/descent.hpp"

namespace octetra::distributed {

/// A cell of which some edges are bisected.
struct DividedCell {
    std::array<VertexIndex, 10> vertices;  ///< corners, then midpoints of edges or none()
    EdgeMask edges = 0;                    ///< the bisected ones

    /// `pieces` are all descendants of the cell, which has this generation.
    DividedCell(const DistributedMesh& mesh, const TransitionCells& cells, const CellRun& pieces,
                std::uint32_t generation);

    [[nodiscard]] CellVertices corners() const {
        return {vertices[0], vertices[1], vertices[2], vertices[3]};
    }
};

/// Puts families into canonical order after a level. If more edges of the parent of transition
/// cells have been bisected, its descendants are the pieces into which all its bisected edges
/// divide it, but in another order.
class FamilyOrder final : public MadeChange {
public:
    explicit FamilyOrder(DistributedMesh& mesh) : mesh_(&mesh) {}
    ~FamilyOrder() override;
    FamilyOrder(const FamilyOrder&) = delete;
    FamilyOrder& operator=(const FamilyOrder&) = delete;
    FamilyOrder(FamilyOrder&&) = delete;
    FamilyOrder& operator=(FamilyOrder&&) = delete;

    /// `pieces` are all descendants of a cell of this generation, the only ones that change in the
    /// mesh and in `descent`.
    void restore(const TransitionCells& cells, const CellRun& pieces, std::uint32_t generation,
                 Descent& descent);
    void keep() noexcept override { before_.clear(); }

private:
    void replace(CellIndex cell, const CellVertices& vertices);

    DistributedMesh* mesh_;
    std::vector<std::pair<CellIndex, CellVertices>> before_;  ///< the replaced cells
};

}  // namespace octetra::distributed
