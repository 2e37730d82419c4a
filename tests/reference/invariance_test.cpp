#include <algorithm>

#include <gtest/gtest.h>

#include <octetra/reference/refine.hpp>

#include "reference/random_history.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/tagged_meshes.hpp"

/// Numbering has no influence: renumbering the input renumbers the result and changes nothing else.
namespace octetra::reference {
namespace {

std::vector<std::pair<Point, Marker>> marked_points(const Mesh& mesh) {
    std::vector<std::pair<Point, Marker>> points;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        points.emplace_back(mesh.points[v], mesh.point_markers[v]);
    }
    std::ranges::sort(points, std::less<>{});
    return points;
}

void expect_same_geometry(const Mesh& a, const Mesh& b) {
    EXPECT_TRUE(test::geometry(a) == test::geometry(b));
    EXPECT_TRUE(test::geometry(a, a.facets, a.facet_markers) ==
                test::geometry(b, b.facets, b.facet_markers));
    EXPECT_TRUE(test::geometry(a, a.edges, a.edge_markers) ==
                test::geometry(b, b.edges, b.edge_markers));
    EXPECT_TRUE(marked_points(a) == marked_points(b));
}

class Invariance : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Invariance, UnderRenumberingOfVerticesCellsAndCorners) {
    const std::uint64_t seed = GetParam();
    const std::vector<Selection> selections{
        {.all = true},
        {.spheres = {{{1, 1.5, 1}, 0.9}}},
        {.boxes = {{{0.5, 0, 0}, {1.5, 1, 3}}}},
        {.regions = {2}},
        {.random = RandomShare{0.1, seed}},
        {.max_volume = 0.17},
    };
    for (const Mesh& mesh :
         {test::tagged(test::kuhn(3, 3, 3)), test::tagged(test::perturbed_kuhn(3, 0.3, seed))}) {
        for (const Selection& selection : selections) {
            for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
                expect_same_geometry(
                    refine(mesh, selection, scheme, 2).mesh,
                    refine(test::renumbered(mesh, seed), selection, scheme, 2).mesh);
            }
        }
    }
}

TEST_P(Invariance, UnderScalingByAPowerOfTwoAndExactTranslation) {
    const Mesh mesh = test::tagged(test::perturbed_kuhn(3, 0.3, GetParam()));
    const auto transformed = [](Mesh m, double scale, const Point& shift) {
        for (Point& p : m.points) {
            p = {p.x * scale + shift.x, p.y * scale + shift.y, p.z * scale + shift.z};
        }
        return m;
    };
    const Point shift{1024, -2048, 512};
    const Selection some{.regions = {1}};
    const Mesh before = refine(mesh, some, Scheme::eight, 2).mesh;
    const Mesh after = refine(transformed(mesh, 0.25, shift), some, Scheme::eight, 2).mesh;
    EXPECT_EQ(after, transformed(before, 0.25, shift));
}

TEST_P(Invariance, OfRefiningAndCoarseningUnderRenumbering) {
    const std::uint64_t seed = GetParam();
    Mesh mesh = random_input(seed);
    mesh.attributes_per_point = 0;
    mesh.point_attributes.clear();
    const auto calls = random_calls(mesh, seed);
    const auto renumbered_calls = random_calls(test::renumbered(mesh, seed), seed);
    for (std::size_t i = 0; i < calls.size(); ++i) {
        const auto meshes = replay(calls[i].after);
        const auto renumbered_meshes = replay(renumbered_calls[i].after);
        ASSERT_EQ(meshes.size(), renumbered_meshes.size());
        for (std::size_t t = 0; t < meshes.size(); ++t) {
            expect_same_geometry(meshes[t].mesh, renumbered_meshes[t].mesh);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Invariance, testing::Range<std::uint64_t>(1, 5));

}  // namespace
}  // namespace octetra::reference
