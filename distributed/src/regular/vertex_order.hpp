#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/adjacency.hpp"
#include "level/transition_cells.hpp"

namespace octetra::distributed {

/// The canonical order of a process's vertices after a regular step, whose levels have appended
/// their midpoints to the vertices: input vertices, then the midpoints of each generation,
/// ascending by the ends of their edges. To be committed when all levels are kept.
struct VertexOrder {
    /// The vertices before the step: as many as there were, and the first midpoint of each
    /// generation.
    struct Before {
        VertexIndex end;
        std::vector<VertexIndex> level_begin;
    };

    /// Collective.
    VertexOrder(const DistributedMesh& mesh, const Before& before,
                const TransitionCells::Generations& generations);

    bool is_changed = false;                      ///< otherwise, the following is empty
    IndexVector<VertexIndex, VertexIndex> after;  ///< the new number of each vertex
    std::vector<VertexIndex> level_begin;         ///< not empty even if the order is unchanged
    IndexVector<VertexIndex, Point> points;       ///< this and the following in the new order
    std::vector<double> point_attributes;
    std::vector<EdgeVertices> midpoint_to_edge;
    std::vector<MidpointMarker> midpoint_markers;

    [[nodiscard]] VertexIndex number_after(VertexIndex v) const {
        return is_changed ? after[v] : v;
    }
    /// Returns the ends of the edges that the midpoints of a level, counted from 0, halve.
    [[nodiscard]] std::span<const EdgeVertices> midpoint_ends(const DistributedMesh& mesh,
                                                              std::size_t level) const;
    void commit(DistributedMesh& mesh) noexcept;

private:
    void find_order(const DistributedMesh& mesh, const Before& before,
                    const TransitionCells::Generations& generations);
    void copy_lists(const DistributedMesh& mesh);

    Incidence<CellIndex, 4>::Heads cells_;
    Incidence<FacetIndex, 3>::Heads facets_;
    Incidence<EdgeIndex, 2>::Heads edges_;
    Incidence<SharedIndex, 2>::Heads shared_edges_;
    Incidence<SharedIndex, 3>::Heads shared_faces_;
};

}  // namespace octetra::distributed
