#pragma once

#include <algorithm>
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
    std::size_t face = 0;  ///< number of the opposite corner
};
[[nodiscard]] inline std::uint64_t tag_of(CellFace f) {
    return std::uint64_t{f.cell.value()} * 4 + f.face;
}
[[nodiscard]] inline CellFace cell_face(std::uint64_t tag) {
    return {CellIndex{static_cast<std::size_t>(tag / 4)}, static_cast<std::size_t>(tag % 4)};
}

/// The view that a process has of a mesh to be verified, with data that several checks use.
struct JudgedMesh {
    const Mesh& mesh;
    Which which = Which::fine;
    Domain domain{};  ///< the process's domain: the whole mesh, or a part
    Totals totals{};  ///< counts of the whole mesh
    /// For each process, a box around the cells in its view; only for a coarse mesh.
    std::vector<Bounds> views{};
    /// The minimum degree of a hub: a vertex with more edges, or an edge with more cells, is a hub,
    /// at which not all pairs are tested. Below this number, testing all pairs is cheaper.
    std::uint32_t many = 128;

    [[nodiscard]] bool owns(VertexIndex v) const { return domain.owns(mesh.points[v]); }
    template <std::size_t N>
    [[nodiscard]] bool owns(const std::array<VertexIndex, N>& vertices) const {
        return domain.owns(vertices, mesh.points);
    }

    /// The cells that later checks inspect: those with four distinct vertices, and only the first
    /// of those with the same vertices. (The others are reported as such, and as nothing else.)
    std::vector<char> sound{};
    /// The orientation +1, 0 or -1 of each cell; also 0 if it is not sound.
    std::vector<std::int8_t> sign{};
    Buckets<3> faces{};  ///< faces of sound cells; tag: tag_of(CellFace)
    EdgeSet edges{};     ///< edges of sound cells

    [[nodiscard]] bool is_sound(CellIndex c) const { return sound[c.value()] != 0; }
    [[nodiscard]] std::array<Point, 4> corners(CellIndex c) const {
        const CellVertices& v = mesh.cells[c];
        return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
    }
};

/// The vertices of a face of a cell, counterclockwise as seen from outside a positive cell.
[[nodiscard]] inline FacetVertices outward_face(const CellVertices& v, std::size_t face) {
    constexpr std::array<std::array<std::size_t, 3>, 4> outward{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const auto& [i, j, k] = outward[face];
    return {v[i], v[j], v[k]};
}

/// Returns whether these three are an even permutation of their ascending order.
[[nodiscard]] inline bool is_even(const FacetVertices& v) {
    const int inversions = (v[0] > v[1] ? 1 : 0) + (v[0] > v[2] ? 1 : 0) + (v[1] > v[2] ? 1 : 0);
    return inversions % 2 == 0;
}

/// Finds the sound cells of a mesh by their vertices, in any order. Faster for cells asked for in
/// the order of the mesh.
class CellFinder {
public:
    explicit CellFinder(const JudgedMesh& judged) : judged_(&judged) {}

    /// Returns the cell with these vertices, or none().
    [[nodiscard]] CellIndex find(const CellVertices& vertices) {
        const auto& cells = judged_->mesh.cells;
        if (next_ < cells.end_index() && judged_->is_sound(next_) && same(vertices, cells[next_])) {
            const CellIndex found = next_;
            ++next_;
            return found;
        }
        CellVertices v = vertices;
        std::sort(v.begin(), v.end());
        for (const auto& entry : judged_->faces.find({v[0], v[1], v[2]})) {
            const CellFace f = cell_face(entry.tag);
            if (cells[f.cell][f.face] != v[3]) continue;
            next_ = f.cell;
            ++next_;
            return f.cell;
        }
        return CellIndex::none();
    }

private:
    /// Precondition: the vertices of `b` are distinct.
    static bool same(const CellVertices& a, const CellVertices& b) {
        return a == b || std::all_of(b.begin(), b.end(), [&](VertexIndex v) {
                   return v == a[0] || v == a[1] || v == a[2] || v == a[3];
               });
    }

    const JudgedMesh* judged_;
    CellIndex next_{0};  ///< after the last one found
};

/// For each vertex, 1 if it belongs to a cell, and 0 otherwise.
[[nodiscard]] inline std::vector<char> used_vertices(const Mesh& mesh) {
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    return used;
}

/// The view of a process that holds the whole mesh.
[[nodiscard]] inline JudgedMesh judged_whole(const Mesh& mesh, Which which) {
    return {
        .mesh = mesh,
        .which = which,
        .totals = {mesh.points.size(), mesh.cells.size(), mesh.facets.size(), mesh.edges.size()}};
}

}  // namespace octetra::verify
