#pragma once

#include "lookup/edge_table.hpp"
#include "lookup/point_lookup.hpp"
#include "mesh/judged_mesh.hpp"

namespace octetra::verify {

/// Pairs of vertices of the fine mesh that may once have been an edge.
///
/// A *line* is an edge of the fine mesh, or two vertices a, b with a vertex m exactly at
/// midpoint(a, b), as rounded by core, such that a, m and m, b are lines. Every edge that was
/// bisected, and recursively its halves, is a line in this sense; so if two vertices are not a
/// line, there was no such edge.
class Lines {
public:
    Lines(const JudgedMesh& fine, const PointLookup& places);

    [[nodiscard]] bool is_whole(VertexIndex a, VertexIndex b) const {
        return fine_->edges.contains({a, b});
    }
    /// Returns the vertex that divides the line a, b into two lines, or none().
    [[nodiscard]] VertexIndex midpoint(VertexIndex a, VertexIndex b);
    [[nodiscard]] bool is_line(VertexIndex a, VertexIndex b) {
        return is_whole(a, b) || !midpoint(a, b).is_none();
    }

    /// Returns whether the fine mesh has halves of an edge instead of the edge.
    [[nodiscard]] bool is_bisected(const EdgeVertices& edge) {
        return !is_whole(edge[0], edge[1]) && !midpoint(edge[0], edge[1]).is_none();
    }

    /// Returns whether midpoint() has returned this vertex for any two others.
    [[nodiscard]] bool halves_a_line(VertexIndex v) const { return halves_[v.value()] != 0; }

private:
    const JudgedMesh* fine_;
    const PointLookup* places_;
    /// Results of midpoint() so far, where a vertex is half way; no_midpoint for none().
    EdgeTable midpoints_;
    std::vector<char> halves_;
};

}  // namespace octetra::verify
