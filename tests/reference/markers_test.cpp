#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>

#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// Data of cells, facets, edges and vertices, transferred by refinement.
namespace octetra::reference {
namespace {

TEST(Regions, GoToTheChildren) {
    Mesh mesh = test::perturbed_kuhn(2, 0.2, 1);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() % 7) - 3);
    }
    const Refinement fine = refine(mesh, {.regions = {2}}, Scheme::eight, 2);
    ASSERT_EQ(fine.mesh.regions.size(), fine.mesh.cells.size());
    for (CellIndex c{0}; c < fine.mesh.cells.end_index(); ++c) {
        ASSERT_EQ(fine.mesh.regions[c], mesh.regions[fine.maps.cell_to_parent[c]]);
    }
}

double area(const Mesh& mesh, const FacetVertices& f) {
    const Point& a = mesh.points[f[0]];
    const Point& b = mesh.points[f[1]];
    const Point& c = mesh.points[f[2]];
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    return std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
}

TEST(Facets, AreTiledByTheBoundaryFacesOfTheRefinedMesh) {
    Mesh mesh = test::perturbed_kuhn(3, 0.3, 4);
    test::list_boundary(mesh);
    const Mesh fine = refine(mesh, {.random = RandomShare{0.2, 1}}, Scheme::eight, 3).mesh;
    Mesh expected = fine;
    expected.facets.clear();
    expected.facet_markers.clear();
    test::list_boundary(expected);
    std::set<std::set<VertexIndex>> tagged;
    std::set<std::set<VertexIndex>> boundary;
    for (const auto& f : fine.facets) tagged.insert({f.begin(), f.end()});
    for (const auto& f : expected.facets) boundary.insert({f.begin(), f.end()});
    EXPECT_EQ(tagged.size(), fine.facets.size()) << "no facet twice";
    EXPECT_EQ(tagged, boundary);

    for (Marker marker = 1; marker <= 5; ++marker) {
        double before = 0;
        double after = 0;
        for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
            if (mesh.facet_markers[f] == marker) before += area(mesh, mesh.facets[f]);
        }
        for (FacetIndex f{0}; f < fine.facets.end_index(); ++f) {
            if (fine.facet_markers[f] == marker) after += area(fine, fine.facets[f]);
        }
        EXPECT_NEAR(after, before, 1e-12 * before);
    }
}

TEST(Facets, InsideTheMeshAreTiledByFacesOfItsCells) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (const CellVertices& cell : mesh.cells) mesh.facets.append({cell[0], cell[1], cell[2]});
    const Mesh fine = refine(mesh, {.spheres = {{{0, 0, 0}, 1}}}, Scheme::eight, 2).mesh;
    std::set<std::set<VertexIndex>> faces;
    for (const CellVertices& cell : fine.cells) {
        for (const auto& [i, j, k] : cell_faces) faces.insert({cell[i], cell[j], cell[k]});
    }
    for (const auto& f : fine.facets) ASSERT_TRUE(faces.contains({f.begin(), f.end()}));
    EXPECT_TRUE(fine.facet_markers.empty());
}

double smallest_angle(const Mesh& mesh, const FacetVertices& f) {
    double least = std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
        const Point& a = mesh.points[f[k]];
        const Point& b = mesh.points[f[(k + 1) % 3]];
        const Point& c = mesh.points[f[(k + 2) % 3]];
        const double along =
            (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y) + (b.z - a.z) * (c.z - a.z);
        least = std::min(least, std::atan2(2 * area(mesh, f), along));
    }
    return least;
}

TEST(Facets, KeepHalfOfTheSmallestAngleOfTheFaceTheyDescendFrom) {
    // Rosenberg & Stenger, "A lower bound on the angles of triangles constructed by bisecting the
    // longest side", Math. Comp. 29 (1975). Here each facet has its own marker.
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Mesh mesh = test::perturbed_kuhn(2, 0.45, seed);
        test::list_boundary(mesh);
        for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
            mesh.facet_markers[f] = static_cast<Marker>(f.value());
        }
        const Mesh fine = refine(mesh, {.all = true}, Scheme::eight, 3).mesh;
        ASSERT_EQ(fine.facets.size(), 64 * mesh.facets.size());
        for (FacetIndex f{0}; f < fine.facets.end_index(); ++f) {
            const FacetIndex parent{static_cast<std::size_t>(fine.facet_markers[f])};
            ASSERT_GE(smallest_angle(fine, fine.facets[f]),
                      smallest_angle(mesh, mesh.facets[parent]) / 2 * (1 - 1e-12));
        }
    }
}

TEST(Edges, GiveTheirMarkersToTheirHalves) {
    Mesh mesh = test::one_cell(test::tie_free_corners);
    mesh.edges.append({VertexIndex{3}, VertexIndex{1}});  // the longest
    mesh.edges.append({VertexIndex{0}, VertexIndex{2}});  // the shortest
    mesh.edge_markers = {8, 9};
    const Mesh fine = refine(mesh, {.all = true}, Scheme::two, 1).mesh;
    const VertexIndex m{4};
    EXPECT_EQ(fine.edges,
              (IndexVector<EdgeIndex, EdgeVertices>{
                  {VertexIndex{3}, m}, {m, VertexIndex{1}}, {VertexIndex{0}, VertexIndex{2}}}));
    EXPECT_EQ(fine.edge_markers, (IndexVector<EdgeIndex, Marker>{8, 8, 9}));
}

TEST(Vertices, AtMidpointsHaveTheEdgesMarkerElseTheSmallestOfTheFacetsElseZero) {
    Mesh mesh = test::one_cell(test::tie_free_corners);
    const auto vertex = [](std::size_t v) { return VertexIndex{v}; };
    mesh.point_markers = {1, 1, 1, 1};
    mesh.facets = {{vertex(0), vertex(1), vertex(2)}, {vertex(0), vertex(1), vertex(3)}};
    mesh.facet_markers = {40, 30};
    mesh.edges = {{vertex(1), vertex(2)}};
    mesh.edge_markers = {50};
    const Mesh fine = refine(mesh, {.all = true}, Scheme::eight, 1).mesh;
    // Midpoints in the order of the edges 01 02 03 12 13 23.
    EXPECT_EQ(fine.point_markers,
              (IndexVector<VertexIndex, Marker>{1, 1, 1, 1, 30, 40, 30, 50, 30, 0}));
}

TEST(Vertices, AtMidpointsHaveTheMeanOfTheAttributesOfTheEnds) {
    Mesh mesh = test::one_cell(test::tie_free_corners);
    mesh.attributes_per_point = 2;
    mesh.point_attributes = {0, 10, 1, 20, 4, 40, 9, 80};
    const Mesh fine = refine(mesh, {.all = true}, Scheme::two, 1).mesh;  // midpoint of 13
    EXPECT_EQ(fine.attributes_per_point, 2U);
    EXPECT_EQ(fine.point_attributes, (std::vector<double>{0, 10, 1, 20, 4, 40, 9, 80, 5, 50}));
}

}  // namespace
}  // namespace octetra::reference
