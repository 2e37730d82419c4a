#include <array>

#include <fmt/format.h>

#include "exact/predicates.hpp"
#include "hubs/fans.hpp"
#include "hubs/hubs.hpp"
#include "hubs/space.hpp"
#include "lookup/box_tree.hpp"
#include "mesh/boundary.hpp"
#include "mesh/checks.hpp"

namespace octetra::verify {
namespace {

/// Tests vertices against cells. Cells search for the vertices in their boxes; at and near hubs,
/// vertices search for cells instead, because boxes of such cells may each contain a large fraction
/// of all vertices.
class HangingSearch {
public:
    HangingSearch(const JudgedMesh& judged, const Hubs& hubs, Findings& findings,
                  const FoundHanging& found)
        : judged_(judged), mesh_(judged.mesh), hubs_(hubs), findings_(findings), found_(found) {}

    void run(const std::vector<VertexIndex>& vertices, const std::vector<CellIndex>& cells) {
        std::vector<Bounds> boxes;
        boxes.reserve(vertices.size());
        for (const VertexIndex v : vertices) boxes.emplace_back().take(mesh_.points[v]);
        const BoxTree places(std::move(boxes));
        std::vector<Fans<4>::Entity> at_hubs;
        Steps step(findings_, cells.size() + (hubs_.none() ? 0 : vertices.size()));
        for (const CellIndex c : cells) {
            step();
            const Apex apex = hubs_.apex_of(mesh_.cells[c]);
            if (!apex.is_none()) {
                at_hubs.push_back({apex, mesh_.cells[c], c.value()});
                continue;
            }
            places.for_each_meeting(bounds_of(judged_.corners(c)),
                                    [&](std::uint32_t number) { judge(vertices[number], c); });
        }
        const Fans<4> fans(mesh_.points, hubs_, std::move(at_hubs));
        if (fans.empty()) return;
        for (const VertexIndex v : vertices) {
            step();
            fans.for_each_near(std::array{v}, search_tests(), [&](const Fans<4>::Entity& cell) {
                judge(v, CellIndex{cell.number});
            });
        }
    }

private:
    void judge(VertexIndex v, CellIndex c) {
        ++search_tests();
        const CellVertices& cell = mesh_.cells[c];
        if (std::find(cell.begin(), cell.end(), v) != cell.end()) return;
        const int touched =
            exact::faces_touched(judged_.corners(c), mesh_.points[v], findings_.arithmetic());
        if (touched >= 0) found_(v, c, touched);
    }

    [[nodiscard]] std::uint64_t& search_tests() { return findings_.verdict().search_tests; }

    const JudgedMesh& judged_;
    const Mesh& mesh_;
    const Hubs& hubs_;
    Findings& findings_;
    const FoundHanging& found_;
};

/// Tests edges against faces that have no vertex in common with them. Edges at hubs are searched by
/// all faces, and other edges search for the faces at hubs; so no pair is tested twice, nor any
/// pair with a common hub.
class CrossingSearch {
public:
    CrossingSearch(const JudgedMesh& judged, const Hubs& hubs, Findings& findings,
                   const FoundCrossing& found)
        : judged_(judged), mesh_(judged.mesh), hubs_(hubs), findings_(findings), found_(found) {}

    void run(const std::vector<EdgeVertices>& edges, const std::vector<FacetVertices>& faces) {
        Steps step(findings_, edges.size() + (hubs_.none() ? 0 : faces.size()));
        std::vector<FacetVertices> away;
        std::vector<Fans<3>::Entity> faces_at_hubs;
        std::vector<Fans<2>::Entity> edges_at_hubs;
        for (const FacetVertices& face : faces) {
            const Apex apex = hubs_.apex_of(face);
            if (apex.is_none()) {
                away.push_back(face);
            } else {
                faces_at_hubs.push_back({apex, face});
            }
        }
        const BoxTree tree = tree_of(away);
        const Fans<3> face_fans(mesh_.points, hubs_, std::move(faces_at_hubs));
        for (const EdgeVertices& edge : edges) {
            step();
            const Apex apex = hubs_.apex_of(edge);
            if (!apex.is_none()) {
                edges_at_hubs.push_back({apex, edge});
                continue;
            }
            tree.for_each_meeting(bounds_of(places(edge)),
                                  [&](std::uint32_t number) { judge(edge, away[number]); });
            face_fans.for_each_near(edge, search_tests(), [&](const Fans<3>::Entity& face) {
                judge(edge, face.vertices);
            });
        }
        const Fans<2> edge_fans(mesh_.points, hubs_, std::move(edges_at_hubs));
        if (edge_fans.empty()) return;
        for (const FacetVertices& face : faces) {
            step();
            edge_fans.for_each_near(face, search_tests(), [&](const Fans<2>::Entity& edge) {
                judge(edge.vertices, face);
            });
        }
    }

private:
    [[nodiscard]] std::uint64_t& search_tests() { return findings_.verdict().search_tests; }

    template <std::size_t N>
    [[nodiscard]] std::array<Point, N> places(const std::array<VertexIndex, N>& vertices) const {
        std::array<Point, N> points;
        for (std::size_t k = 0; k < N; ++k) points[k] = mesh_.points[vertices[k]];
        return points;
    }

    [[nodiscard]] BoxTree tree_of(const std::vector<FacetVertices>& faces) const {
        std::vector<Bounds> boxes;
        boxes.reserve(faces.size());
        for (const FacetVertices& face : faces) boxes.push_back(bounds_of(places(face)));
        return BoxTree(std::move(boxes));
    }

    void judge(const EdgeVertices& edge, const FacetVertices& face) {
        ++search_tests();
        for (const VertexIndex v : face) {
            if (v == edge[0] || v == edge[1]) return;
        }
        if (!owns_meeting_of(bounds_of(places(edge)), bounds_of(places(face)))) return;
        if (exact::meet(places(edge), places(face), findings_.arithmetic())) found_(edge, face);
    }

    /// A pair belongs to the process that owns the lowest corner of the intersection of their
    /// boxes.
    [[nodiscard]] bool owns_meeting_of(const Bounds& a, const Bounds& b) const {
        return judged_.domain.owns({std::max(a.low[0], b.low[0]), std::max(a.low[1], b.low[1]),
                                    std::max(a.low[2], b.low[2])});
    }

    const JudgedMesh& judged_;
    const Mesh& mesh_;
    const Hubs& hubs_;
    Findings& findings_;
    const FoundCrossing& found_;
};

void report_hanging(VertexIndex v, CellIndex c, int touched, Which which, Findings& findings) {
    constexpr std::array<std::string_view, 3> where{"inside the cell", "on a face of the cell",
                                                    "on an edge of the cell"};
    findings.add(touched == 0 ? Code::vertex_in_cell : Code::hanging_vertex,
                 [&]() -> Findings::Description {
                     return {{entity(v, which), entity(c, which)},
                             std::string(where[static_cast<std::size_t>(touched)]),
                             "outside of every cell that does not have it"};
                 });
}

}  // namespace

void search_hanging(const JudgedMesh& judged, const Hubs& hubs,
                    const std::vector<VertexIndex>& vertices, const std::vector<CellIndex>& cells,
                    Findings& findings, const FoundHanging& found) {
    HangingSearch(judged, hubs, findings, found).run(vertices, cells);
}

void search_crossings(const JudgedMesh& judged, const Hubs& hubs,
                      const std::vector<EdgeVertices>& edges,
                      const std::vector<FacetVertices>& faces, Findings& findings,
                      const FoundCrossing& found) {
    CrossingSearch(judged, hubs, findings, found).run(edges, faces);
}

std::string check_hanging(const JudgedMesh& judged, Findings& findings) {
    const std::vector<char> used = used_vertices(judged.mesh);
    std::vector<VertexIndex> vertices;
    for (VertexIndex v{0}; v < judged.mesh.points.end_index(); ++v) {
        if (used[v.value()] != 0 && judged.owns(v)) vertices.push_back(v);
    }
    std::vector<CellIndex> cells;
    for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
        if (judged.sign[c.value()] > 0) cells.push_back(c);  // others have no interior
    }
    const Hubs hubs(judged);
    search_hanging(judged, hubs, vertices, cells, findings,
                   [&](VertexIndex v, CellIndex c, int touched) {
                       // A point on three faces is a corner: two vertices coincide, which is
                       // reported elsewhere.
                       if (touched < 3) report_hanging(v, c, touched, judged.which, findings);
                   });
    return {};
}

std::string check_boundary_crossings(const JudgedMesh& judged, Findings& findings) {
    const auto report = [&](const EdgeVertices& edge, const FacetVertices& face) {
        findings.add(Code::boundary_crosses, [&]() -> Findings::Description {
            return {{entity(edge, judged.which), entity(face, judged.which)},
                    "the edge meets the face",
                    "no point in common but vertices"};
        });
    };
    const Hubs hubs(judged);
    const Boundary boundary = boundary_of(judged);
    std::vector<EdgeVertices> edges;
    edges.reserve(judged.edges.size());
    judged.edges.for_each([&](const EdgeVertices& edge) { edges.push_back(edge); });
    search_crossings(judged, hubs, edges, boundary.faces, findings, report);
    std::vector<FacetVertices> inner_faces;  // boundary faces are done above
    judged.faces.for_each_group([&](const FacetVertices& face, auto cells) {
        if (cells.size() > 1) inner_faces.push_back(face);
    });
    search_crossings(judged, hubs, boundary.edges, inner_faces, findings, report);
    return {};
}

}  // namespace octetra::verify
