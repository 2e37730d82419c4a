#pragma once

#include <memory>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_numbers.hpp"

namespace octetra::distributed {

/// A mesh as an input of its own for as long as this lives: its cells, tagged facets and edges are
/// roots, and it has no history. Then it is again as it was, unless it is to be kept so.
///
/// A root's descendants stand together in the canonical order, and vertices come before those that
/// are made of them. So all numbers are what they were, and what is refined from here on gets those
/// that it would have got; only where it comes from is forgotten.
class CellsAsRoots {
public:
    CellsAsRoots() = default;
    ~CellsAsRoots();
    CellsAsRoots(const CellsAsRoots&) = delete;
    CellsAsRoots& operator=(const CellsAsRoots&) = delete;
    CellsAsRoots(CellsAsRoots&&) = delete;
    CellsAsRoots& operator=(CellsAsRoots&&) = delete;

    /// Collective. From now on. The mesh must be in canonical order, and stay so. `known`: the
    /// numbers of its vertices, or null. What fails on one process throws alike on all; the mesh is
    /// then as it was.
    void begin(DistributedMesh& mesh, const CanonicalNumbers* known);
    void keep() noexcept { mesh_ = nullptr; }

private:
    void swap_with(DistributedMesh& mesh) noexcept;

    DistributedMesh* mesh_ = nullptr;
    // What the mesh has not now.
    std::vector<GlobalVertex> input_vertices_;
    std::vector<Marker> input_vertex_markers_;
    std::vector<VertexIndex> level_begin_;
    std::vector<EdgeVertices> midpoint_to_edge_;
    std::vector<MidpointMarker> midpoint_markers_;
    AncestorMap cell_ancestors_;
    AncestorMap facet_ancestors_;
    AncestorMap edge_ancestors_;
    std::uint64_t input_vertex_count_ = 0;
    std::uint64_t input_cell_count_ = 0;
    SharedFeatures features_;
};

}  // namespace octetra::distributed
