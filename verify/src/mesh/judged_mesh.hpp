#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/verify/mesh_slice.hpp>
#include <octetra/verify/violation.hpp>

#include "lookup/box_tree.hpp"
#include "lookup/buckets.hpp"
#include "lookup/edge_set.hpp"
#include "parts/domain.hpp"

namespace octetra::verify {

/// A face of a cell, packed into a tag of Buckets.
struct CellFace {
    CellIndex cell;
    std::size_t face = 0;  ///< opposite which corner
};
[[nodiscard]] inline std::uint64_t tag_of(CellFace f) {
    return std::uint64_t{f.cell.value()} * 4 + f.face;
}
[[nodiscard]] inline CellFace cell_face(std::uint64_t tag) {
    return {CellIndex{static_cast<std::size_t>(tag / 4)}, static_cast<std::size_t>(tag % 4)};
}

/// What a process sees of a mesh under judgement, with what several checks ask of it.
struct JudgedMesh {
    const Mesh& mesh;
    Which which = Which::fine;
    Domain domain{};  ///< what this process answers for: all of the mesh, or its part
    Totals totals{};  ///< of the whole mesh
    /// Of each process a box around the cells that it sees; of a coarse mesh only.
    std::vector<Bounds> views{};
    /// A vertex of more edges, or an edge of more cells, is a hub: not all pairs of what is there
    /// are looked at. With fewer that costs less than being clever.
    std::uint32_t many = 128;

    [[nodiscard]] bool owns(VertexIndex v) const { return domain.owns(mesh.points[v]); }
    template <std::size_t N>
    [[nodiscard]] bool owns(const std::array<VertexIndex, N>& vertices) const {
        return domain.owns(vertices, mesh.points);
    }

    /// Cells that the later checks look at: those with four different vertices, and of several with
    /// the same ones the first. (The others are reported as what they are, and as nothing else.)
    std::vector<char> sound{};
    /// +1, 0, -1 of each cell; 0 also where it is not sound.
    std::vector<std::int8_t> sign{};
    bool keeps_cells = true;  ///< else `cells` stays empty: only refinements are asked for them
    Buckets<4> cells{};       ///< of all with four different vertices; tag: the cell's number
    Buckets<3> faces{};       ///< of sound cells; tag: tag_of(CellFace)
    EdgeSet edges{};          ///< of sound cells

    [[nodiscard]] bool is_sound(CellIndex c) const { return sound[c.value()] != 0; }
    [[nodiscard]] std::array<Point, 4> corners(CellIndex c) const {
        const CellVertices& v = mesh.cells[c];
        return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
    }
};

/// The vertices of a face of a cell, anticlockwise as seen from outside a positive cell.
[[nodiscard]] inline FacetVertices outward_face(const CellVertices& v, std::size_t face) {
    constexpr std::array<std::array<std::size_t, 3>, 4> outward{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const auto& [i, j, k] = outward[face];
    return {v[i], v[j], v[k]};
}

/// Are these three an even permutation of their ascending order?
[[nodiscard]] inline bool is_even(const FacetVertices& v) {
    const int inversions = (v[0] > v[1] ? 1 : 0) + (v[0] > v[2] ? 1 : 0) + (v[1] > v[2] ? 1 : 0);
    return inversions % 2 == 0;
}

/// For each vertex, 1 if it belongs to a cell, and 0 otherwise.
[[nodiscard]] inline std::vector<char> used_vertices(const Mesh& mesh) {
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    return used;
}

/// A mesh that this process has all of.
[[nodiscard]] inline JudgedMesh judged_whole(const Mesh& mesh, Which which) {
    return {
        .mesh = mesh,
        .which = which,
        .totals = {mesh.points.size(), mesh.cells.size(), mesh.facets.size(), mesh.edges.size()}};
}

}  // namespace octetra::verify
