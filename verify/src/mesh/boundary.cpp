#include "mesh/boundary.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "exact/predicates.hpp"
#include "hubs/space.hpp"
#include "lookup/box_tree.hpp"
#include "mesh/checks.hpp"

// The proof, and the terms of this file, are in docs/verify-proof.md, "A valid mesh".

namespace octetra::verify {
namespace {

/// The closed box in which the process holds all cells.
Bounds view_of(const Domain& domain) { return {domain.low, domain.high}; }

bool contains(const Bounds& box, const Point& p) {
    Bounds place;
    place.take(p);
    return box.meets(place);
}

std::array<Point, 3> points_of_face(const FacetVertices& v, const Mesh& mesh) {
    return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
}

/// Returns a + share * (b - a).
Point between(const Point& a, const Point& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

/// Returns whether any two boundary faces meet in common vertices and edges only.
bool is_embedded(const JudgedMesh& judged, const Boundary& boundary, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    std::vector<char> on_boundary(mesh.points.size(), 0);
    std::vector<CellIndex> cells;
    for (const CellFace f : boundary.cell_faces) cells.push_back(f.cell);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    for (const FacetVertices& face : boundary.faces) {
        for (const VertexIndex v : face) on_boundary[v.value()] = 1;
    }
    std::vector<VertexIndex> vertices;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (on_boundary[v.value()] != 0 && judged.owns(v)) vertices.push_back(v);
    }
    const Hubs hubs(judged);
    bool embedded = true;
    search_hanging(judged, hubs, vertices, cells, findings,
                   [&](VertexIndex, CellIndex, int) { embedded = false; });
    if (!embedded) return false;
    std::vector<FacetVertices> faces;
    for (const CellIndex c : cells) {
        for (std::size_t k = 0; k < 4; ++k) {
            FacetVertices face = outward_face(mesh.cells[c], k);
            std::sort(face.begin(), face.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    search_crossings(judged, hubs, boundary.edges, faces, findings,
                     [&](const EdgeVertices&, const FacetVertices&) { embedded = false; });
    return embedded;
}

/// Shells: sets of boundary faces joined by edges of two boundary faces.
class Shells {
public:
    explicit Shells(std::size_t faces) : parent_(faces) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    [[nodiscard]] std::uint32_t shell_of(std::uint32_t face) {
        while (parent_[face] != face) face = parent_[face] = parent_[parent_[face]];
        return face;
    }
    void join(std::uint32_t f, std::uint32_t g) {
        f = shell_of(f);
        g = shell_of(g);
        parent_[std::max(f, g)] = std::min(f, g);
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// Shows that no point is in the interiors of two cells, if the boundary is embedded.
class CoverCheck {
public:
    CoverCheck(const JudgedMesh& judged, const Boundary& boundary, Findings& findings)
        : judged_(judged),
          mesh_(judged.mesh),
          boundary_(boundary),
          findings_(findings),
          view_(view_of(judged.domain)),
          tests_left_(1000 + 4 * judged.mesh.cells.size()) {}

    bool run() {
        if (mesh_.cells.empty()) return true;
        std::vector<Point> samples;
        if (!judged_.domain.is_everything) {
            const auto inside = sample_of_domain();
            if (!inside) return false;
            samples.push_back(*inside);
        }
        return add_samples_of_shells(samples) && are_each_in_one_cell(samples);
    }

private:
    /// Returns a point within the domain, not on its border.
    [[nodiscard]] std::optional<Point> sample_of_domain() const {
        const Domain& d = judged_.domain;
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            const Point p = centroid(judged_.corners(c));
            if (d.low[0] < p.x && p.x < d.high[0] && d.low[1] < p.y && p.y < d.high[1] &&
                d.low[2] < p.z && p.z < d.high[2]) {
                return p;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] bool is_in_view(const Bounds& box) const { return view_.meets(box); }

    [[nodiscard]] Bounds box_of(const auto& vertices) const {
        Bounds box;
        for (const VertexIndex v : vertices) box.take(mesh_.points[v]);
        return box;
    }

    /// Adds a point beside a face of each shell in view, within its cell. Returns false if there is
    /// none that is certain.
    bool add_samples_of_shells(std::vector<Point>& samples) {
        const auto count = static_cast<std::uint32_t>(boundary_.faces.size());
        Shells shells(count);
        std::vector<std::uint32_t> first_at(boundary_.edges.size(), count);
        for (std::uint32_t f = 0; f < count; ++f) {
            for (const std::uint32_t e : boundary_.edges_of_face[f]) {
                if (boundary_.faces_at_edge[e] != 2) continue;
                if (first_at[e] == count) {
                    first_at[e] = f;
                } else if (is_in_view(box_of(boundary_.edges[e]))) {
                    shells.join(first_at[e], f);  // elsewhere other faces at it may be missing
                }
            }
        }
        std::vector<Bounds> boxes;
        for (const FacetVertices& face : boundary_.faces) boxes.push_back(box_of(face));
        const BoxTree tree(boxes);
        enum : char { not_in_view, needed, found };
        std::vector<char> state(count, not_in_view);
        std::vector<int> attempts(count, 0);
        for (std::uint32_t f = 0; f < count; ++f) {
            if (!is_in_view(boxes[f])) continue;
            const std::uint32_t shell = shells.shell_of(f);
            if (state[shell] == found || attempts[shell] == most_attempts) continue;
            state[shell] = needed;
            if (const auto sample = sample_beside(f, tree)) {
                samples.push_back(*sample);
                state[shell] = found;
            } else if (is_in_view_whole(boxes[f])) {
                ++attempts[shell];
            }
        }
        return std::find(state.begin(), state.end(), needed) == state.end();
    }

    [[nodiscard]] bool is_in_view_whole(const Bounds& box) const {
        return contains(view_, {box.low[0], box.low[1], box.low[2]}) &&
               contains(view_, {box.high[0], box.high[1], box.high[2]});
    }

    /// Returns a point within the cell of a boundary face such that a segment from there passes the
    /// face and meets no other boundary face.
    [[nodiscard]] std::optional<Point> sample_beside(std::uint32_t f, const BoxTree& tree) {
        const CellFace cell_face = boundary_.cell_faces[f];
        const auto corners = points_of_face(boundary_.faces[f], mesh_);
        const Point apex = mesh_.points[mesh_.cells[cell_face.cell][cell_face.face]];
        // Near the middle, but not exactly: in a lattice, that may lie on planes of other faces.
        const Point middle = between(between(corners[0], corners[1], 0.45), corners[2], 0.29);
        for (const double share : {0x1p-3, 0x1p-8}) {
            const std::array<Point, 2> segment{between(middle, apex, share),
                                               between(middle, apex, -share)};
            const Bounds box = bounds_of(segment);
            if (!is_finite(segment[0]) || !is_finite(segment[1]) || !is_in_view_whole(box)) {
                continue;
            }
            if (!passes(segment, corners, apex)) continue;
            bool clear = true;
            tree.for_each_meeting(box, [&](std::uint32_t g) {
                if (g == f || !clear) return;
                if (!may_test()) {
                    clear = false;
                    return;
                }
                clear = !exact::meet(segment, points_of_face(boundary_.faces[g], mesh_),
                                     findings_.arithmetic());
            });
            if (clear) return segment[0];
        }
        return std::nullopt;
    }

    /// Returns whether the segment starts on the side of the apex and passes through the interior
    /// of the triangle.
    [[nodiscard]] bool passes(const std::array<Point, 2>& segment,
                              const std::array<Point, 3>& triangle, const Point& apex) {
        const auto& [a, b, c] = triangle;
        const auto& [p, q] = segment;
        const auto side = [&](const Point& s, const Point& t, const Point& u, const Point& v) {
            return exact::orientation(s, t, u, v, findings_.arithmetic());
        };
        const int inner = side(a, b, c, apex);
        const int turn = side(p, q, a, b);
        return inner != 0 && side(a, b, c, p) == inner && side(a, b, c, q) == -inner && turn != 0 &&
               side(p, q, b, c) == turn && side(p, q, c, a) == turn;
    }

    /// Returns whether each of the points, all in view, lies in the interior of one cell and in no
    /// other.
    bool are_each_in_one_cell(const std::vector<Point>& samples) {
        std::vector<Bounds> boxes;
        for (const Point& p : samples) boxes.emplace_back().take(p);
        const BoxTree tree(std::move(boxes));
        std::vector<std::uint32_t> cells_at(samples.size(), 0);
        bool on_face = false;
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            const auto corners = judged_.corners(c);
            tree.for_each_meeting(bounds_of(corners), [&](std::uint32_t i) {
                if (!may_test()) return;
                const int touched =
                    exact::faces_touched(corners, samples[i], findings_.arithmetic());
                if (touched >= 0) ++cells_at[i];
                on_face = on_face || touched > 0;
            });
        }
        return tests_left_ > 0 && !on_face &&
               std::all_of(cells_at.begin(), cells_at.end(),
                           [](std::uint32_t cells) { return cells == 1; });
    }

    /// Counts a test of a pair. Returns false if there have been too many, as with many shells at
    /// one edge, whose boxes all overlap.
    bool may_test() {
        ++findings_.verdict().search_tests;
        if (tests_left_ > 0) --tests_left_;
        return tests_left_ > 0;
    }

    static constexpr int most_attempts = 16;  ///< faces of a shell that are tried

    const JudgedMesh& judged_;
    const Mesh& mesh_;
    const Boundary& boundary_;
    Findings& findings_;
    Bounds view_;
    std::uint64_t tests_left_;
};

}  // namespace

Boundary boundary_of(const JudgedMesh& judged) {
    Boundary boundary;
    boundary.cell_faces = boundary_faces(judged);
    // By cell, so that what lies close together is stored so, and cells can be listed once.
    std::sort(boundary.cell_faces.begin(), boundary.cell_faces.end(),
              [](CellFace f, CellFace g) { return tag_of(f) < tag_of(g); });
    for (const CellFace f : boundary.cell_faces) {
        boundary.faces.push_back(outward_face(judged.mesh.cells[f.cell], f.face));
    }
    const Buckets<2> edges(judged.mesh.points.size(), [&](auto&& visit) {
        for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
            const FacetVertices& face = boundary.faces[f];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [i, j] = triangle_edges[k];
                visit(EdgeVertices{face[i], face[j]}, 4 * f + k);
            }
        }
    });
    boundary.edges_of_face.resize(boundary.faces.size());
    edges.for_each_group([&](const EdgeVertices& edge, auto entries) {
        for (const auto& entry : entries) {
            boundary.edges_of_face[entry.tag / 4][entry.tag % 4] =
                static_cast<std::uint32_t>(boundary.edges.size());
        }
        boundary.edges.push_back(edge);
        boundary.faces_at_edge.push_back(static_cast<std::uint32_t>(entries.size()));
    });
    return boundary;
}

bool boundary_proves_conformity(const JudgedMesh& judged, Findings& findings) {
    const Boundary boundary = boundary_of(judged);
    const bool covers_once = CoverCheck(judged, boundary, findings).run();
    if (any(findings.group(), !covers_once)) return false;
    return !any(findings.group(), !is_embedded(judged, boundary, findings));
}

}  // namespace octetra::verify
