#include <fmt/format.h>

#include "box_tree.hpp"
#include "exact/predicates.hpp"
#include "subject.hpp"

namespace octetra::verify {
namespace {

/// On how many faces of a cell a point lies that is not outside; -1 if it is outside.
int faces_touched(const std::array<Point, 4>& corners, const Point& p, Arithmetic& arithmetic) {
    int touched = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        auto with_p = corners;
        with_p[k] = p;
        const int sign = exact::orientation(with_p[0], with_p[1], with_p[2], with_p[3], arithmetic);
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

}  // namespace

std::string check_hanging(const Subject& subject, Findings& findings) {
    const Mesh& mesh = subject.mesh;
    std::vector<char> used(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    std::vector<Bounds> boxes(mesh.points.size());
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) boxes[v.value()].take(mesh.points[v]);
    const BoxTree vertices(std::move(boxes));

    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        if (subject.sign[c.value()] <= 0) continue;  // no inside to speak of
        const auto corners = subject.corners(c);
        const CellVertices& cell = mesh.cells[c];
        vertices.for_each_meeting(bounds_of(corners), [&](std::uint32_t number) {
            const VertexIndex v{number};
            if (used[number] == 0 || std::find(cell.begin(), cell.end(), v) != cell.end()) return;
            const int touched = faces_touched(corners, mesh.points[v], findings.arithmetic());
            // On three faces it is at a corner: two vertices at one place, which is reported as
            // such.
            if (touched >= 0 && touched < 3) report(subject, c, v, touched, findings);
        });
    }
    return {};
}

std::string check_boundary_crossings(const Subject& subject, Findings& findings) {
    const Mesh& mesh = subject.mesh;
    std::vector<FacetVertices> faces;
    for (const CellFace f : boundary_faces(subject)) {
        if (subject.sign[f.cell.value()] != 0) {
            faces.push_back(outward_face(mesh.cells[f.cell], f.face));
        }
    }
    const auto corners = [&](const FacetVertices& f) {
        return std::array<Point, 3>{mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
    };
    std::vector<Bounds> boxes;
    boxes.reserve(faces.size());
    for (const FacetVertices& f : faces) boxes.push_back(bounds_of(corners(f)));
    const BoxTree tree(std::move(boxes));

    const Buckets<2> edges(mesh.points.size(), [&](auto&& visit) {
        for (const FacetVertices& f : faces) {
            for (const auto& [i, j] : triangle_edges) visit(EdgeVertices{f[i], f[j]}, 0);
        }
    });
    edges.for_each_group([&](const EdgeVertices& edge, auto) {
        const std::array<Point, 2> segment{mesh.points[edge[0]], mesh.points[edge[1]]};
        tree.for_each_meeting(bounds_of(segment), [&](std::uint32_t number) {
            const FacetVertices& face = faces[number];
            for (const VertexIndex v : face) {
                if (v == edge[0] || v == edge[1]) return;
            }
            if (!exact::meet(segment, corners(face), findings.arithmetic())) return;
            findings.add(Code::boundary_crosses, [&]() -> Findings::Description {
                return {{entity(edge, subject.which), entity(face, subject.which)},
                        "the edge meets the face",
                        "no common point, as they have no vertex in common"};
            });
        });
    });
    return {};
}

}  // namespace octetra::verify
