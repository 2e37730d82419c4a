#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/group_names.hpp>
#include <octetra/core/index.hpp>
#include <octetra/core/point.hpp>

/// The mesh model: flat arrays without links between entities. Adjacency is built where it is
/// needed.
namespace octetra {

using CellVertices = std::array<VertexIndex, 4>;
using FacetVertices = std::array<VertexIndex, 3>;
using EdgeVertices = std::array<VertexIndex, 2>;
using Marker = std::int32_t;

/// Corners of the six edges of a cell, of its four faces (face i is opposite corner i), and of the
/// three edges of a triangle, as local positions.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> cell_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> cell_faces{
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
inline constexpr std::array<std::array<std::uint8_t, 2>, 3> triangle_edges{
    {{0, 1}, {0, 2}, {1, 2}}};

/// A tetrahedral mesh of this process. Invariants of a mesh returned by read_mesh():
///  - coordinates are finite and less than coordinate_limit in magnitude; vertex numbers are in
///  range, and those of a cell, facet or edge are distinct;
///  - every cell is positively oriented, exactly;
///  - every facet is a face of some cell, every edge an edge of some cell;
///  - no two cells have the same vertices, and no two lie on the same side of a tagged facet;
///  - a repeated facet or edge has the same marker each time;
///  - numbers in `features` are in range, ascending and distinct.
/// Not guaranteed: that cells do not overlap elsewhere, even at a face that is not tagged, that
/// vertices are distinct points, or that each vertex belongs to a cell. verify_mesh() of
/// octetra_verify checks these.
/// A list documented as "or empty" is empty if the file had no such column.
struct Mesh {
    IndexVector<VertexIndex, Point> points;
    IndexVector<VertexIndex, Marker> point_markers;  ///< one per vertex, or empty
    std::size_t attributes_per_point = 0;
    std::vector<double> point_attributes;  ///< vertex by vertex, attributes_per_point each

    IndexVector<CellIndex, CellVertices> cells;
    IndexVector<CellIndex, Marker> regions;  ///< region tag of each cell, or empty

    IndexVector<FacetIndex, FacetVertices> facets;  ///< tagged triangles: boundaries, interfaces
    IndexVector<FacetIndex, Marker> facet_markers;  ///< one per facet, or empty

    IndexVector<EdgeIndex, EdgeVertices> edges;   ///< tagged edges: ridges, wires
    IndexVector<EdgeIndex, Marker> edge_markers;  ///< one per edge, or empty

    FeatureLists features;

    std::vector<GroupName> group_names;  ///< in file order; each group once

    std::uint32_t index_base = 0;  ///< number of the first vertex, cell ... in files: 0 or 1

    friend bool operator==(const Mesh&, const Mesh&) = default;
};

}  // namespace octetra
