#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include <octetra/core/edge_order.hpp>
#include <octetra/reference/history.hpp>

#include "support/refinement.hpp"

/// The rules of coarsening, implemented again on points instead of numbers.
namespace octetra::test {

/// An edge by its end points, the smaller first.
using PointPair = std::array<Point, 2>;

inline PointPair between(const Point& a, const Point& b) {
    return a < b ? PointPair{a, b} : PointPair{b, a};
}

inline std::set<PointPair> segments(const Mesh& mesh, const std::vector<EdgeVertices>& edges) {
    std::set<PointPair> result;
    for (const auto& [a, b] : edges) result.insert(between(mesh.points[a], mesh.points[b]));
    return result;
}

/// The three edges of a face, the longest first.
using FaceEdges = std::array<PointPair, 3>;

inline std::vector<FaceEdges> faces_of(const Mesh& mesh) {
    std::vector<FaceEdges> faces;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners p = corners_of(mesh, c);
        for (const auto& [i, j, k] : cell_faces) {
            FaceEdges face{between(p[i], p[j]), between(p[i], p[k]), between(p[j], p[k])};
            std::ranges::sort(face, [](const PointPair& e, const PointPair& f) {
                return longer({e[0], e[1]}, {f[0], f[1]});
            });
            faces.push_back(face);
        }
    }
    return faces;
}

/// Returns whether every face of the mesh that has one of the edges has its longest edge among
/// them.
inline bool is_closed(const Mesh& mesh, const std::vector<EdgeVertices>& edges) {
    const std::set<PointPair> set = segments(mesh, edges);
    return std::ranges::all_of(faces_of(mesh), [&](const FaceEdges& face) {
        return set.contains(face[0]) || (!set.contains(face[1]) && !set.contains(face[2]));
    });
}

/// Adds the corners of every cell that has one of the edges.
inline void add_corners_of_cells_at(const std::set<PointPair>& edges, const Mesh& mesh,
                                    std::set<Point>& points) {
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners p = corners_of(mesh, c);
        if (std::ranges::any_of(cell_edges, [&](const auto& edge) {
                return edges.contains(between(p[edge[0]], p[edge[1]]));
            })) {
            points.insert(p.begin(), p.end());
        }
    }
}

/// Rule (b) of coarsened() within one step: follows midpoints along longer and longer edges.
inline void add_midpoints_of_longest(const std::set<PointPair>& bisected, const Mesh& before,
                                     std::set<Point>& points) {
    std::map<PointPair, std::vector<PointPair>> to_longest;
    for (const FaceEdges& face : faces_of(before)) {
        to_longest[face[1]].push_back(face[0]);
        to_longest[face[2]].push_back(face[0]);
    }
    std::vector<PointPair> left;
    for (const PointPair& edge : bisected) {
        if (points.contains(midpoint(edge[0], edge[1]))) left.push_back(edge);
    }
    while (!left.empty()) {
        const PointPair edge = left.back();
        left.pop_back();
        for (const PointPair& longest : to_longest[edge]) {
            if (points.insert(midpoint(longest[0], longest[1])).second) left.push_back(longest);
        }
    }
}

/// The points of the vertices that coarsened() must keep, and of no others. Midpoints must be
/// exact.
struct RequiredPoints {
    std::set<Point> by_cells;  ///< rule (a)
    std::set<Point> all;       ///< and those added by rule (b)
};

inline RequiredPoints points_that_stay(const reference::History& history,
                                       const reference::CellMarks& may_coarsen) {
    const auto meshes = reference::replay(history);
    const Mesh& present = meshes.back().mesh;
    RequiredPoints stay;
    stay.by_cells = {history.input.points.begin(), history.input.points.end()};
    for (CellIndex c{0}; c < present.cells.end_index(); ++c) {
        const Corners p = corners_of(present, c);
        if (may_coarsen[c] == 0) stay.by_cells.insert(p.begin(), p.end());
    }
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        add_corners_of_cells_at(segments(meshes[t].mesh, history.steps[t]), meshes[t].mesh,
                                stay.by_cells);
    }
    stay.all = stay.by_cells;
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        add_midpoints_of_longest(segments(meshes[t].mesh, history.steps[t]), meshes[t].mesh,
                                 stay.all);
    }
    return stay;
}

inline std::set<Point> points_of(const Mesh& mesh) {
    return {mesh.points.begin(), mesh.points.end()};
}

}  // namespace octetra::test
