#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "level/full_sweep/full_sweep_closure.hpp"
#include "level/full_sweep/local_edge_set.hpp"
#include "level/level.hpp"
#include "level/marked_cells.hpp"
#include "level/midpoints.hpp"
#include "pattern/cell_orders.hpp"

namespace octetra::distributed {

/// Level for many marked cells: numbers edges and rebuilds all lists. Takes time proportional to
/// the process's part, with the least time for each bisected cell.
class FullSweepLevel final : public Level {
public:
    /// The mesh must be in canonical order.
    FullSweepLevel(DistributedMesh& mesh, const MarkedCells& marked, double local_below,
                   const TransitionCells* transition);

    /// Marks edges of the marked cells, the same as passed to the constructor.
    void mark(const MarkedCells& marked, Scheme scheme);

    [[nodiscard]] MarkedEdges& closure() override { return closure_; }
    [[nodiscard]] MarkedCells closed_marks() override;
    void bisect_edges() override;
    [[nodiscard]] std::size_t cell_count_afterwards() override;
    [[nodiscard]] RoundingFailure bisect_cells(std::size_t cell_count) override;
    void bisect_tagged() override;
    void bisect_interfaces() override;
    [[nodiscard]] std::vector<std::vector<VertexIndex>> shared_midpoints() const override;
    [[nodiscard]] ListChanges changes() override;
    void commit() noexcept override;
    [[nodiscard]] std::unique_ptr<MadeChange> commit_reversibly() override;
    [[nodiscard]] std::size_t cells_touched() const override { return orders_.end_index().value(); }

private:
    /// A list of the mesh after the level.
    template <class List>
    struct NewList {
        List entities;
        std::vector<std::uint32_t> first;  ///< as in AncestorMap
        /// The division of each entity before the level; empty for cells.
        std::vector<std::uint8_t> divisions;

        void swap(List& list, AncestorMap& ancestors) noexcept {
            list.swap(entities);
            ancestors.first.swap(first);
        }
    };
    /// All lists that a level replaces.
    struct Lists {
        NewList<IndexVector<CellIndex, CellVertices>> cells;
        NewList<IndexVector<FacetIndex, FacetVertices>> facets;
        NewList<IndexVector<EdgeIndex, EdgeVertices>> edges;  ///< tagged ones
        std::vector<Interface> interfaces;

        void swap(DistributedMesh& mesh) noexcept;
    };
    class MadeLevel;
    template <class List>
    static NewList<List> replaced_by_children(const List& list, const AncestorMap& ancestors,
                                              auto&& append_children);
    [[nodiscard]] EntityTransfer changes_of_cells();

    void mark(CellIndex cell, EdgeMask mask);

    DistributedMesh* mesh_;
    LocalEdgeSet edges_;
    const EdgeNumbering* numbering_ = &edges_.numbering();
    CellOrders orders_;
    FullSweepClosure closure_;
    IndexVector<CellIndex, EdgeMask> marked_;        ///< of each cell, once computed
    IndexVector<EdgeIndex, VertexIndex> midpoints_;  ///< of each edge, or none()
    std::unique_ptr<AppendedMidpoints> appended_;    ///< once the midpoints are appended
    Lists lists_;
};

}  // namespace octetra::distributed
