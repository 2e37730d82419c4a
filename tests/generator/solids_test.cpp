#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/generator/solids.hpp>
#include <octetra/generator/tetgen.hpp>

#include "mesh_facts.hpp"

namespace octetra::generator::test {
namespace {

constexpr double rounding = 1e-12;

class Solids : public testing::Test {
protected:
    void SetUp() override {
        if (!has_tetgen()) GTEST_SKIP() << "built without TetGen";
    }
};

double distance_from_origin(const Point& p) { return std::sqrt(squared_length({p, Point{}})); }

double distance_from_axis(const Point& p) { return std::hypot(p.x, p.y); }

/// Requirements on every solid without an interface.
void expect_sound(const Mesh& mesh, int characteristic) {
    EXPECT_TRUE(all_positively_oriented(mesh));
    EXPECT_EQ(tagged_facets(mesh), boundary_of(mesh));
    EXPECT_EQ(mesh.facets.size(), boundary_of(mesh).size());
    EXPECT_EQ(mesh.facet_markers.size(), mesh.facets.size());
    EXPECT_EQ(euler_characteristic(mesh), characteristic);
    EXPECT_EQ(mesh.index_base, 0U);
    EXPECT_EQ(mesh.edge_markers.size(), mesh.edges.size());
    const auto edges = edges_of(mesh);
    for (const auto& [a, b] : mesh.edges) {
        EXPECT_TRUE(edges.contains({std::min(a, b), std::max(a, b)}));
    }
}

double largest_cell(const Mesh& mesh) {
    double largest = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        largest = std::max(largest, six_volumes(corners_of(mesh, c)));
    }
    return largest / 6;
}

double regular_volume(double edge_length) {
    return edge_length * edge_length * edge_length * std::numbers::sqrt2 / 12;
}

TEST_F(Solids, SphereKeepsItsSurfaceOnTheSphere) {
    const Mesh mesh = sphere(2, 0.5);
    expect_sound(mesh, 1);
    EXPECT_EQ(mesh.facets.size(), 20U * 5 * 5);
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        for (const Point& p : corners_of(mesh, f)) {
            EXPECT_NEAR(distance_from_origin(p), 2, rounding);
        }
    }
    EXPECT_NEAR(six_volumes(mesh) / 6, 32 * std::numbers::pi / 3, 1.5);
}

TEST_F(Solids, TorusHasAHoleAndKeepsItsSurface) {
    const Mesh mesh = torus(1, 0.4, 0.25);
    expect_sound(mesh, 0);
    EXPECT_EQ(mesh.facets.size(), 2U * 26 * 11);
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        for (const Point& p : corners_of(mesh, f)) {
            EXPECT_NEAR(std::hypot(distance_from_axis(p) - 1, p.z), 0.4, rounding);
        }
    }
}

TEST_F(Solids, FicheraIsACubeLessAnOctantWithItsReentrantPartsMarked) {
    const Mesh mesh = fichera();
    expect_sound(mesh, 1);
    EXPECT_NEAR(six_volumes(mesh), 42, 42 * rounding);
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        bool outer = false;
        for (double Point::*const axis : {&Point::x, &Point::y, &Point::z}) {
            const auto corners = corners_of(mesh, f);
            const auto at = [&](double side) {
                return std::ranges::all_of(corners,
                                           [&](const Point& p) { return p.*axis == side; });
            };
            outer = outer || at(-1) || at(1);
        }
        EXPECT_EQ(mesh.facet_markers[f], outer ? 1 : 2);
    }
    EXPECT_EQ(facets_by_marker(mesh).size(), 2U);
}

TEST_F(Solids, NoCellIsLargerThanTheEdgeLengthAllows) {
    const double bound = 1 + rounding;
    EXPECT_LE(largest_cell(fichera(0.4)), regular_volume(0.4) * bound);
    EXPECT_LE(largest_cell(gear({.edge_length = 0.1})), regular_volume(0.1) * bound);
    EXPECT_LE(largest_cell(two_material(0.3, 0.15)), regular_volume(0.15) * bound);
}

TEST_F(Solids, FicheraListsItsRidges) {
    const Mesh mesh = fichera();
    double convex = 0;
    double re_entrant = 0;
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) {
        const auto& [a, b] = mesh.edges[e];
        const double length = std::sqrt(squared_length({mesh.points[a], mesh.points[b]}));
        (mesh.edge_markers[e] == 2 ? re_entrant : convex) += length;
    }
    // Convex edges: nine of length 2, and nine of length 1 (three pairs and three shortened ones).
    // The three re-entrant edges meet at the origin.
    EXPECT_NEAR(convex, 9 * 2 + 9 * 1, 1e-9);
    EXPECT_NEAR(re_entrant, 3, 1e-9);
}

TEST_F(Solids, GearHasItsBoreAndItsMarkersWhereTheyBelong) {
    const Mesh mesh = gear();
    expect_sound(mesh, 0);
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        const auto corners = corners_of(mesh, f);
        const auto all = [&](auto&& holds) { return std::ranges::all_of(corners, holds); };
        const bool lid = all([](const Point& p) { return p.z == 0; }) ||
                         all([](const Point& p) { return p.z == 0.3; });
        const bool bore =
            all([](const Point& p) { return distance_from_axis(p) < 0.3 + rounding; });
        EXPECT_EQ(mesh.facet_markers[f], lid ? 1 : bore ? 3 : 2);
    }
    EXPECT_EQ(facets_by_marker(mesh).size(), 3U);
}

TEST_F(Solids, GearListsItsRidges) {
    const Gear shape;
    const Mesh mesh = gear(shape);
    std::map<Marker, double> lengths;
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) {
        const auto& [a, b] = mesh.edges[e];
        const Point& p = mesh.points[a];
        const Point& q = mesh.points[b];
        lengths[mesh.edge_markers[e]] += std::sqrt(squared_length({p, q}));
        const bool in_bore = distance_from_axis(p) < 0.3 + rounding;
        EXPECT_EQ(mesh.edge_markers[e], in_bore ? 3 : p.z == q.z ? 1 : 2);
    }
    ASSERT_EQ(lengths.size(), 3U);
    // Four upright edges for each tooth; two rims of ten sides.
    EXPECT_NEAR(lengths[2], 4 * 12 * 0.3, 1e-9);
    EXPECT_NEAR(lengths[3], 2 * 10 * 2 * 0.3 * std::sin(std::numbers::pi / 10), 1e-9);
}

TEST_F(Solids, GearsOfFewAndManyTeethCanBeMade) {
    expect_sound(gear({.teeth = 3, .bore_radius = 0.6}), 0);
    expect_sound(
        gear({.teeth = 40, .outer_radius = 20, .thickness = 4, .bore_radius = 5, .edge_length = 4}),
        0);
}

TEST_F(Solids, TwoMaterialInterfaceIsTaggedAndSeparatesTheRegions) {
    const Mesh mesh = two_material();
    EXPECT_TRUE(all_positively_oriented(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 1);
    EXPECT_NEAR(six_volumes(mesh), 6, 6 * rounding);
    ASSERT_EQ(mesh.regions.size(), mesh.cells.size());

    std::set<FacetVertices> expected_outer;
    std::set<FacetVertices> expected_interface;
    for (const auto& [face, cells] : cells_of_faces(mesh)) {
        if (cells.size() == 1) expected_outer.insert(face);
        if (cells.size() == 2 && mesh.regions[cells[0]] != mesh.regions[cells[1]]) {
            expected_interface.insert(face);
        }
    }
    std::map<Marker, std::set<FacetVertices>> tagged;
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        EXPECT_TRUE(tagged[mesh.facet_markers[f]].insert(sorted(mesh.facets[f])).second);
    }
    EXPECT_EQ(tagged.size(), 2U);
    EXPECT_EQ(tagged[1], expected_outer);
    EXPECT_EQ(tagged[2], expected_interface);
}

TEST_F(Solids, TwoMaterialRegionsAreTaggedOutsideAndInside) {
    const Mesh mesh = two_material(0.3, 0.2);
    double inside = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto corners = corners_of(mesh, c);
        Point centre;
        for (const Point& p : corners) {
            centre = {centre.x + p.x / 4, centre.y + p.y / 4, centre.z + p.z / 4};
        }
        const double distance = std::sqrt(squared_length({centre, Point{0.5, 0.5, 0.5}}));
        ASSERT_TRUE(mesh.regions[c] == 1 || mesh.regions[c] == 2);
        if (mesh.regions[c] == 2) {
            EXPECT_LT(distance, 0.3);
            inside += six_volumes(corners) / 6;
        } else {
            EXPECT_GT(distance, 0.3 * 0.79);  // radius of an icosahedron's inscribed sphere
        }
    }
    const double ball = 4 * std::numbers::pi / 3 * 0.3 * 0.3 * 0.3;
    EXPECT_LT(inside, ball);
    EXPECT_GT(inside, 0.8 * ball);
    EXPECT_EQ(mesh.edge_markers, (IndexVector<EdgeIndex, Marker>(mesh.edges.size(), 1)));
}

TEST_F(Solids, AreMadeTheSameEveryTime) {
    EXPECT_EQ(sphere(), sphere());
    EXPECT_EQ(gear(), gear());
}

TEST_F(Solids, SizesFromMinuteToHugeCanBeMade) {
    expect_sound(sphere(1e-29, 5e-30), 1);
    expect_sound(torus(1e30, 4e29, 3e29), 0);
}

TEST(SolidParameters, LengthsMustBePositiveAndFinite) {
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW((void)sphere(bad), InputError) << bad;
        EXPECT_THROW((void)sphere(1, bad), InputError) << bad;
        EXPECT_THROW((void)torus(bad), InputError) << bad;
        EXPECT_THROW((void)torus(1, bad), InputError) << bad;
        EXPECT_THROW((void)torus(1, 0.4, bad), InputError) << bad;
        EXPECT_THROW((void)fichera(bad), InputError) << bad;
        EXPECT_THROW((void)gear({.outer_radius = bad}), InputError) << bad;
        EXPECT_THROW((void)gear({.thickness = bad}), InputError) << bad;
        EXPECT_THROW((void)gear({.bore_radius = bad}), InputError) << bad;
        EXPECT_THROW((void)gear({.edge_length = bad}), InputError) << bad;
        EXPECT_THROW((void)two_material(bad), InputError) << bad;
        EXPECT_THROW((void)two_material(0.3, bad), InputError) << bad;
    }
}

TEST(SolidParameters, ImpossibleShapesAreRefused) {
    EXPECT_THROW((void)torus(1, 1), InputError);
    EXPECT_THROW((void)torus(1, 2), InputError);
    EXPECT_THROW((void)gear({.teeth = 0}), InputError);
    EXPECT_THROW((void)gear({.teeth = 2}), InputError);
    EXPECT_THROW((void)gear({.teeth = 1001}), InputError);
    EXPECT_THROW((void)gear({.bore_radius = 0.8}), InputError);
    EXPECT_THROW((void)gear({.bore_radius = 5}), InputError);
    EXPECT_THROW((void)two_material(0.5), InputError);
    EXPECT_THROW((void)two_material(0.7), InputError);
}

TEST(SolidParameters, TooManyCellsAreRefusedBeforeTheWork) {
    EXPECT_THROW((void)sphere(1, 1e-4), InputError);
    EXPECT_THROW((void)torus(1, 0.4, 1e-4), InputError);
    EXPECT_THROW((void)fichera(1e-4), InputError);
    EXPECT_THROW((void)gear({.edge_length = 1e-4}), InputError);
    EXPECT_THROW((void)two_material(0.3, 1e-4), InputError);
    EXPECT_THROW((void)two_material(0.4999999, 0.2), InputError);
}

}  // namespace
}  // namespace octetra::generator::test
