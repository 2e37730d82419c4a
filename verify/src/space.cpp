#include <array>
#include <optional>

#include <fmt/format.h>

#include "box_tree.hpp"
#include "exact/predicates.hpp"
#include "subject.hpp"

namespace octetra::verify {
namespace {

/// On how many faces of a cell a point lies that is not outside; -1 if it is outside. In a lattice
/// most points near a cell are in the plane of some face, which takes rational numbers to tell, but
/// clearly beyond another; so that is asked first.
int faces_touched(const std::array<Point, 4>& corners, const Point& p, Arithmetic& arithmetic) {
    const auto with_p_as_corner = [&](std::size_t k, auto&& judge) {
        auto q = corners;
        q[k] = p;
        return judge(q[0], q[1], q[2], q[3], arithmetic);
    };
    std::array<std::optional<int>, 4> signs;
    for (std::size_t k = 0; k < 4; ++k) {
        signs[k] = with_p_as_corner(k, exact::clear_orientation);
        if (signs[k] == -1) return -1;
    }
    int touched = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const int sign = signs[k] ? *signs[k] : with_p_as_corner(k, exact::orientation);
        if (sign < 0) return -1;
        if (sign == 0) ++touched;
    }
    return touched;
}

void report(const Subject& subject, CellIndex c, VertexIndex v, int touched, Findings& findings) {
    constexpr std::array<std::string_view, 3> where{"inside the cell", "on a face of the cell",
                                                    "on an edge of the cell"};
    findings.add(touched == 0 ? Code::vertex_in_cell : Code::hanging_vertex,
                 [&]() -> Findings::Description {
                     return {{entity(v, subject.which), entity(c, subject.which)},
                             std::string(where[static_cast<std::size_t>(touched)]),
                             "outside of every cell that does not have it"};
                 });
}

/// Edges against faces, one of the two on the boundary: if they have no vertex in common, they must
/// not meet. (With one in common they could cross in their plane, the edge leaving the face through
/// the opposite side. Then another face at that edge, or at that side, of the same cell meets what
/// it has no vertex in common with: else that cell would be flat. An edge cannot end within a face:
/// check_hanging would have found that.)
class CrossingCheck {
public:
    CrossingCheck(const Subject& subject, Findings& findings)
        : subject_(subject), mesh_(subject.mesh), findings_(findings) {
        for (const CellFace f : boundary_faces(subject)) {
            faces_.push_back(outward_face(mesh_.cells[f.cell], f.face));
        }
        const Buckets<2> edges(mesh_.points.size(), [&](auto&& visit) {
            for (const FacetVertices& f : faces_) {
                for (const auto& [i, j] : triangle_edges) visit(EdgeVertices{f[i], f[j]}, 0);
            }
        });
        edges.for_each_group([&](const EdgeVertices& edge, auto) { edges_.push_back(edge); });
    }

    void run() {
        const BoxTree boundary_faces = tree_of(faces_);
        subject_.edges.for_each([&](const EdgeVertices& edge) {
            boundary_faces.for_each_meeting(bounds_of(places(edge)), [&](std::uint32_t number) {
                judge(edge, faces_[number]);
            });
        });
        const BoxTree boundary_edges = tree_of(edges_);
        subject_.faces.for_each_group([&](const FacetVertices& face, auto cells) {
            if (cells.size() == 1) return;  // with all edges, above
            boundary_edges.for_each_meeting(bounds_of(places(face)), [&](std::uint32_t number) {
                judge(edges_[number], face);
            });
        });
    }

private:
    template <std::size_t N>
    [[nodiscard]] std::array<Point, N> places(const std::array<VertexIndex, N>& vertices) const {
        std::array<Point, N> points;
        for (std::size_t k = 0; k < N; ++k) points[k] = mesh_.points[vertices[k]];
        return points;
    }

    template <std::size_t N>
    [[nodiscard]] BoxTree tree_of(const std::vector<std::array<VertexIndex, N>>& entities) const {
        std::vector<Bounds> boxes;
        boxes.reserve(entities.size());
        for (const auto& entity : entities) boxes.push_back(bounds_of(places(entity)));
        return BoxTree(std::move(boxes));
    }

    void judge(const EdgeVertices& edge, const FacetVertices& face) {
        for (const VertexIndex v : face) {
            if (v == edge[0] || v == edge[1]) return;
        }
        if (!owns_meeting_of(bounds_of(places(edge)), bounds_of(places(face)))) return;
        if (!exact::meet(places(edge), places(face), findings_.arithmetic())) return;
        findings_.add(Code::boundary_crosses, [&]() -> Findings::Description {
            return {{entity(edge, subject_.which), entity(face, subject_.which)},
                    "the edge meets the face",
                    "no point in common but vertices"};
        });
    }

    /// A pair belongs to the lowest corner of what their boxes have in common.
    [[nodiscard]] bool owns_meeting_of(const Bounds& a, const Bounds& b) const {
        return subject_.domain.owns({std::max(a.low[0], b.low[0]), std::max(a.low[1], b.low[1]),
                                     std::max(a.low[2], b.low[2])});
    }

    const Subject& subject_;
    const Mesh& mesh_;
    Findings& findings_;
    std::vector<FacetVertices> faces_;  ///< of the boundary
    std::vector<EdgeVertices> edges_;   ///< of these faces
};

}  // namespace

std::string check_hanging(const Subject& subject, Findings& findings) {
    const Mesh& mesh = subject.mesh;
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    std::vector<VertexIndex> judged;
    std::vector<Bounds> boxes;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (used[v.value()] == 0 || !subject.owns(v)) continue;
        judged.push_back(v);
        boxes.emplace_back().take(mesh.points[v]);
    }
    const BoxTree vertices(std::move(boxes));

    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (subject.sign[c.value()] <= 0) continue;  // no inside to speak of
        const auto corners = subject.corners(c);
        const CellVertices& cell = mesh.cells[c];
        vertices.for_each_meeting(bounds_of(corners), [&](std::uint32_t number) {
            const VertexIndex v = judged[number];
            if (std::find(cell.begin(), cell.end(), v) != cell.end()) return;
            const int touched = faces_touched(corners, mesh.points[v], findings.arithmetic());
            // On three faces it is at a corner: two vertices at one place, which is reported as
            // such.
            if (touched >= 0 && touched < 3) report(subject, c, v, touched, findings);
        });
    }
    return {};
}

std::string check_boundary_crossings(const Subject& subject, Findings& findings) {
    CrossingCheck(subject, findings).run();
    return {};
}

}  // namespace octetra::verify
