#pragma once

#include <array>
#include <set>
#include <vector>

#include "properties/case.hpp"

/// One level of refinement, computed in the simplest way, for comparison with the engines.
namespace octetra::properties {

/// Edges by their ends, lower first.
using Edges = std::set<EdgeVertices>;

[[nodiscard]] EdgeVertices edge_between(VertexIndex a, VertexIndex b);

/// The six edges of a cell, in the order of cell_edges.
[[nodiscard]] std::array<EdgeVertices, 6> edges_of(const CellVertices& cell);

/// The longest of these edges.
[[nodiscard]] EdgeVertices longest(const Mesh& mesh, const std::vector<EdgeVertices>& edges);

/// The longest edges of the four faces of a cell; face i lies opposite corner i.
[[nodiscard]] std::array<EdgeVertices, 4> longest_of_faces(const Mesh& mesh,
                                                           const CellVertices& cell);

/// Returns whether the cell is marked at the first level.
[[nodiscard]] bool is_marked(const Case& c, CellIndex cell);

/// The edges that a marked cell marks.
[[nodiscard]] Edges marked_by(const Case& c, CellIndex cell);

/// The closure of these edges.
[[nodiscard]] Edges closure_of(const Mesh& mesh, Edges edges);

}  // namespace octetra::properties
