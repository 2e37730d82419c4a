#include <array>

#include <fmt/format.h>

#include "exact/predicates.hpp"
#include "hubs/fans.hpp"
#include "hubs/hubs.hpp"
#include "lookup/box_tree.hpp"
#include "mesh/checks.hpp"

namespace octetra::verify {
namespace {

/// Tests vertices against cells. Cells search for the vertices in their boxes; at and near hubs,
/// vertices search for cells instead, because boxes of such cells may each contain a large fraction
/// of all vertices.
class HangingCheck {
public:
    HangingCheck(const JudgedMesh& judged, Findings& findings)
        : judged_(judged), mesh_(judged.mesh), findings_(findings), hubs_(judged) {
        const std::vector<char> used = used_vertices(mesh_);
        for (VertexIndex v{0}; v < mesh_.points.end_index(); ++v) {
            if (used[v.value()] != 0 && judged.owns(v)) vertices_.push_back(v);
        }
    }

    void run() {
        std::vector<Bounds> boxes;
        for (const VertexIndex v : vertices_) boxes.emplace_back().take(mesh_.points[v]);
        const BoxTree places(std::move(boxes));
        std::vector<Fans<4>::Entity> at_hubs;
        Steps step(findings_, mesh_.cells.size() + (hubs_.none() ? 0 : vertices_.size()));
        for (CellIndex c{0}; c < mesh_.cells.end_index(); ++c) {
            step();
            if (judged_.sign[c.value()] <= 0) continue;  // no interior
            const Apex apex = hubs_.apex_of(mesh_.cells[c]);
            if (!apex.is_none()) {
                at_hubs.push_back({apex, mesh_.cells[c], c.value()});
                continue;
            }
            places.for_each_meeting(bounds_of(judged_.corners(c)),
                                    [&](std::uint32_t number) { judge(vertices_[number], c); });
        }
        const Fans<4> cells(mesh_.points, hubs_, std::move(at_hubs));
        if (cells.empty()) return;
        for (const VertexIndex v : vertices_) {
            step();
            cells.for_each_near(std::array{v}, search_tests(), [&](const Fans<4>::Entity& cell) {
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
        // A point on three faces is a corner: two vertices coincide, which is reported elsewhere.
        if (touched >= 0 && touched < 3) report(v, c, touched);
    }

    void report(VertexIndex v, CellIndex c, int touched) {
        constexpr std::array<std::string_view, 3> where{"inside the cell", "on a face of the cell",
                                                        "on an edge of the cell"};
        findings_.add(touched == 0 ? Code::vertex_in_cell : Code::hanging_vertex,
                      [&]() -> Findings::Description {
                          return {{entity(v, judged_.which), entity(c, judged_.which)},
                                  std::string(where[static_cast<std::size_t>(touched)]),
                                  "outside of every cell that does not have it"};
                      });
    }

    [[nodiscard]] std::uint64_t& search_tests() { return findings_.verdict().search_tests; }

    const JudgedMesh& judged_;
    const Mesh& mesh_;
    Findings& findings_;
    Hubs hubs_;
    std::vector<VertexIndex> vertices_;  ///< vertices to be tested
};

/// Tests edges against faces, one of the two on the boundary: if they have no common vertex, they
/// must not meet. (With a common vertex they could cross in their plane, the edge leaving the face
/// through the opposite side. Then another face of the same cell, at that edge or at that side,
/// meets an entity with which it has no common vertex, since otherwise that cell would be flat. An
/// edge cannot end within a face: check_hanging would have found this.)
///
/// Edges at hubs are searched by all faces, and other edges search for the faces at hubs; so no
/// pair is tested twice, nor any pair with a common hub.
class CrossingCheck {
public:
    CrossingCheck(const JudgedMesh& judged, Findings& findings)
        : judged_(judged),
          mesh_(judged.mesh),
          findings_(findings),
          hubs_(judged),
          step_(findings, steps_of(judged, hubs_)) {
        for (const CellFace f : boundary_faces(judged)) {
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
        check_away_from_hubs();
        if (hubs_.none()) return;
        check_edges_at_hubs();
        check_faces_at_hubs();
    }

private:
    /// The number of edges and faces that search for others, once away from hubs and once at hubs.
    /// (Most faces have two cells.)
    static std::uint64_t steps_of(const JudgedMesh& judged, const Hubs& hubs) {
        const std::uint64_t once = judged.edges.size() + 2 * judged.mesh.cells.size();
        return hubs.none() ? once : 2 * once;
    }

    template <std::size_t N>
    [[nodiscard]] bool is_at_hub(const std::array<VertexIndex, N>& entity) const {
        return !hubs_.apex_of(entity).is_none();
    }

    void for_each_inner_face(auto&& visit) const {
        judged_.faces.for_each_group([&](const FacetVertices& face, auto cells) {
            if (cells.size() > 1) visit(face);
        });
    }

    void check_away_from_hubs() {
        const auto away_from_hubs = [&](auto entities) {
            std::erase_if(entities, [&](const auto& entity) { return is_at_hub(entity); });
            return entities;
        };
        const auto faces = away_from_hubs(faces_);
        const BoxTree boundary_faces = tree_of(faces);
        judged_.edges.for_each([&](const EdgeVertices& edge) {
            step_();
            if (is_at_hub(edge)) return;
            boundary_faces.for_each_meeting(
                bounds_of(places(edge)), [&](std::uint32_t number) { judge(edge, faces[number]); });
        });
        const auto edges = away_from_hubs(edges_);
        const BoxTree boundary_edges = tree_of(edges);
        for_each_inner_face([&](const FacetVertices& face) {  // boundary faces are done above
            step_();
            if (is_at_hub(face)) return;
            boundary_edges.for_each_meeting(
                bounds_of(places(face)), [&](std::uint32_t number) { judge(edges[number], face); });
        });
    }

    void check_edges_at_hubs() {
        std::vector<Fans<2>::Entity> boundary;
        std::vector<Fans<2>::Entity> inner;
        judged_.edges.for_each([&](const EdgeVertices& edge) {
            const Apex apex = hubs_.apex_of(edge);
            if (apex.is_none()) return;
            const bool on_boundary = std::binary_search(edges_.begin(), edges_.end(), edge);
            (on_boundary ? boundary : inner).push_back({apex, edge});
        });
        const Fans<2> boundary_edges(mesh_.points, hubs_, std::move(boundary));
        const Fans<2> inner_edges(mesh_.points, hubs_, std::move(inner));
        const auto look_for = [&](const Fans<2>& edges, const FacetVertices& face) {
            edges.for_each_near(face, search_tests(),
                                [&](const Fans<2>::Entity& edge) { judge(edge.vertices, face); });
        };
        for (const FacetVertices& face : faces_) {
            look_for(boundary_edges, face);
            look_for(inner_edges, face);
        }
        for_each_inner_face([&](const FacetVertices& face) {
            step_();
            look_for(boundary_edges, face);
        });
    }

    void check_faces_at_hubs() {
        std::vector<Fans<3>::Entity> boundary;
        std::vector<Fans<3>::Entity> inner;
        const auto sort_into = [&](std::vector<Fans<3>::Entity>& list, const FacetVertices& face) {
            const Apex apex = hubs_.apex_of(face);
            if (!apex.is_none()) list.push_back({apex, face});
        };
        for (const FacetVertices& face : faces_) sort_into(boundary, face);
        for_each_inner_face([&](const FacetVertices& face) { sort_into(inner, face); });
        const Fans<3> boundary_faces(mesh_.points, hubs_, std::move(boundary));
        const Fans<3> inner_faces(mesh_.points, hubs_, std::move(inner));
        const auto look_for = [&](const Fans<3>& faces, const EdgeVertices& edge) {
            faces.for_each_near(edge, search_tests(),
                                [&](const Fans<3>::Entity& face) { judge(edge, face.vertices); });
        };
        judged_.edges.for_each([&](const EdgeVertices& edge) {
            step_();
            if (!is_at_hub(edge)) look_for(boundary_faces, edge);
        });
        for (const EdgeVertices& edge : edges_) {
            if (!is_at_hub(edge)) look_for(inner_faces, edge);
        }
    }

    [[nodiscard]] std::uint64_t& search_tests() { return findings_.verdict().search_tests; }

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
        ++search_tests();
        for (const VertexIndex v : face) {
            if (v == edge[0] || v == edge[1]) return;
        }
        if (!owns_meeting_of(bounds_of(places(edge)), bounds_of(places(face)))) return;
        if (!exact::meet(places(edge), places(face), findings_.arithmetic())) return;
        findings_.add(Code::boundary_crosses, [&]() -> Findings::Description {
            return {{entity(edge, judged_.which), entity(face, judged_.which)},
                    "the edge meets the face",
                    "no point in common but vertices"};
        });
    }

    /// A pair belongs to the process that owns the lowest corner of the intersection of their
    /// boxes.
    [[nodiscard]] bool owns_meeting_of(const Bounds& a, const Bounds& b) const {
        return judged_.domain.owns({std::max(a.low[0], b.low[0]), std::max(a.low[1], b.low[1]),
                                    std::max(a.low[2], b.low[2])});
    }

    const JudgedMesh& judged_;
    const Mesh& mesh_;
    Findings& findings_;
    Hubs hubs_;
    Steps step_;
    std::vector<FacetVertices> faces_;  ///< faces of the boundary
    std::vector<EdgeVertices> edges_;   ///< edges of these faces, ascending
};

}  // namespace

std::string check_hanging(const JudgedMesh& judged, Findings& findings) {
    HangingCheck(judged, findings).run();
    return {};
}

std::string check_boundary_crossings(const JudgedMesh& judged, Findings& findings) {
    CrossingCheck(judged, findings).run();
    return {};
}

}  // namespace octetra::verify
