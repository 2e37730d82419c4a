#pragma once

#include "lookup/edge_table.hpp"
#include "lookup/places.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// Which pairs of vertices of the fine mesh were once an edge.
///
/// A *line* is an edge of the fine mesh, or two vertices a, b with a vertex m exactly at
/// midpoint(a, b), as core rounds it, such that a, m and m, b are lines. Every edge that was there
/// before it was bisected, and its halves again, is a line in that sense; so a line's absence
/// proves that there was no such edge.
class Lines {
public:
    Lines(const JudgedMesh& fine, const Places& places);

    [[nodiscard]] bool is_whole(VertexIndex a, VertexIndex b) const {
        return whole_.find(a, b) != EdgeTable::absent;
    }
    /// The vertex that halves the line a, b into two; none() if there is none.
    [[nodiscard]] VertexIndex midpoint(VertexIndex a, VertexIndex b);
    [[nodiscard]] bool is_line(VertexIndex a, VertexIndex b) {
        return is_whole(a, b) || !midpoint(a, b).is_none();
    }

    /// Has midpoint() found this vertex for any two others?
    [[nodiscard]] bool halves_a_line(VertexIndex v) const { return halves_[v.value()] != 0; }

private:
    const Mesh* mesh_;
    const Places* places_;
    EdgeTable whole_;      ///< edges of the fine mesh
    EdgeTable midpoints_;  ///< what midpoint() has found so far; no_midpoint if nothing
    std::vector<char> halves_;
};

}  // namespace octetra::verify
