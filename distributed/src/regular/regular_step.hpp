#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/distributed/adaptation.hpp>
#include <octetra/distributed/refine.hpp>

#include "adapt/mesh_state.hpp"
#include "level/made_change.hpp"
#include "level/marked_cells.hpp"
#include "level/planned_level.hpp"
#include "level/transition_cells.hpp"
#include "level/tuning.hpp"
#include "regular/children.hpp"
#include "regular/descent.hpp"
#include "regular/pending_edges.hpp"
#include "regular/vertex_order.hpp"

namespace octetra::distributed {

/// A step of refinement with Closure::regular on this process. It changes the mesh of a state,
/// apart from the order of the vertices; the destructor reverts all changes unless commit() was
/// called.
///
/// The set B of bisected edges, as defined by reference::refined_regularly(), is extended by rules
/// that only need the present cells. An edge has the generation of the regular cells with it. If an
/// edge of a transition cell is marked that is not an edge of its parent, then the family is
/// completed: all edges of the parent are marked, which are of the previous generation (3). A face
/// of the parent that is still whole has its longest edge marked if it has a marked edge (2). Each
/// rule has one marked edge as its premise: the closure of a set is the union of the closures of
/// its edges, and closed edges need not be processed again.
///
/// Levels then bisect the edges of one generation each, beginning with the lowest: larger closed
/// sets of edges of a cell divide it into pieces of the pieces that smaller ones divide it into.
/// New regular cells can cause marks of higher generations, and these can complete further
/// families, whose edges are bisected before.
class RegularStep {
public:
    RegularStep(AdaptiveMesh::State& state, const RefineOptions& options, const Tuning& tuning);

    /// Collective, within a transaction. Bisects edges until all rules are fulfilled. Returns false
    /// on all processes if nothing is marked. Throws InputError if a rounded midpoint would make a
    /// cell flat or inverted, also one that the step bisects further, or if the result would have
    /// more than RefineOptions::max_cells cells.
    [[nodiscard]] bool plan(const MarkedCells& marked);

    [[nodiscard]] Adaptation commit() noexcept;

private:
    /// A family of which cells are bisected.
    struct DividedFamily {
        CellRun siblings;                   ///< by the numbers before the level
        CellRun pieces;                     ///< by the numbers after it
        std::vector<EdgeVertices> pending;  ///< edges of the siblings
    };
    using DividedFamilies = std::vector<DividedFamily>;
    /// Vertices that this process shares with another one, ascending.
    struct SharedVertices {
        int rank = 0;
        std::vector<VertexIndex> vertices;
    };

    void mark(const MarkedCells& marked);
    [[nodiscard]] bool is_one_of_eight(CellIndex cell, std::uint32_t generation) const;
    void bisect_all();
    [[nodiscard]] PlannedLevel close_open();
    [[nodiscard]] PlannedLevel pending_level(std::uint32_t generation);
    void prepare_order(MarkedCells& marked);
    void bisect(std::uint32_t generation, PlannedLevel plan);
    [[nodiscard]] DividedFamilies divided_families(const MarkedCells& bisected);
    void find_pending(DividedFamily& family);
    void update_kinds(const MarkedCells& bisected, const Children& children);
    void update_families(DividedFamilies& families, const Children& children,
                         std::uint32_t generation);
    void check_allowed() const;

    [[nodiscard]] std::vector<SharedVertices> shared_after() const;
    void number_vertices(const std::vector<SharedVertices>& shared);
    void describe();

    AdaptiveMesh::State* state_;
    DistributedMesh* mesh_;
    RefineOptions options_;  ///< of each level of the step
    std::uint64_t max_cells_;
    Tuning tuning_;
    bool is_first_ = true;
    VertexOrder::Before before_;
    std::size_t cell_count_before_;
    std::size_t facet_count_before_;
    std::size_t edge_count_before_;
    TransitionCells cells_;
    PendingEdges pending_;
    Descent of_cells_;
    Descent of_facets_;
    Descent of_edges_;
    std::vector<std::vector<VertexIndex>> new_shared_;  ///< the new vertices of each interface
    SynchronisationCounts counts_;
    MadeChanges changes_;

    std::optional<VertexOrder> order_;
    CanonicalNumbers numbers_;
    Sharing<VertexIndex> sharing_;
    Adaptation adaptation_;
};

}  // namespace octetra::distributed
