#include <gtest/gtest.h>

#include <octetra/distributed/partition.hpp>

#include "distributed/loop.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "history/replay.hpp"
#include "history/steps_of.hpp"
#include "support/meshes.hpp"

/// The history extracted from a part reproduces the part.
namespace octetra::distributed {
namespace {

void expect_equal(const AncestorMap& a, const AncestorMap& b) {
    EXPECT_EQ(a.roots, b.roots);
    EXPECT_EQ(a.first, b.first);
    EXPECT_EQ(a.markers, b.markers);
}

void expect_equal(const DistributedMesh& a, const DistributedMesh& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.point_attributes, b.point_attributes);
    EXPECT_EQ(a.input_vertices, b.input_vertices);
    EXPECT_EQ(a.level_begin, b.level_begin);
    EXPECT_EQ(a.midpoint_to_edge, b.midpoint_to_edge);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.facets, b.facets);
    EXPECT_EQ(a.edges, b.edges);
    expect_equal(a.cell_ancestors, b.cell_ancestors);
    expect_equal(a.facet_ancestors, b.facet_ancestors);
    expect_equal(a.edge_ancestors, b.edge_ancestors);
    ASSERT_EQ(a.midpoint_markers.size(), b.midpoint_markers.size());
    for (std::size_t i = 0; i < a.midpoint_markers.size(); ++i) {
        EXPECT_EQ(a.midpoint_markers[i].source, b.midpoint_markers[i].source);
        EXPECT_EQ(a.midpoint_markers[i].marker, b.midpoint_markers[i].marker);
    }
    ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
    for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
        EXPECT_EQ(a.interfaces[i].rank, b.interfaces[i].rank);
        EXPECT_EQ(a.interfaces[i].edges, b.interfaces[i].edges);
        EXPECT_EQ(a.interfaces[i].faces, b.interfaces[i].faces);
    }
}

DistributedMesh with_interfaces(DistributedMesh mesh, const DistributedMesh& other) {
    mesh.interfaces = other.interfaces;
    return mesh;
}

class Replay : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Replay, OfTheStepsExtractedFromAPartReproducesItBitByBit) {
    std::mt19937_64 random(GetParam());
    const Mesh mesh = test::marked(test::perturbed_kuhn(3, 0.2, GetParam()), 1);
    const auto ranks = partition_cells(mesh, test::world().size(),
                                       parse_partition("random:" + std::to_string(GetParam())));
    test::Loop loop(distribute(test::world(), mesh, ranks));
    const DistributedMesh input = distribute(test::world(), mesh, ranks);
    constexpr std::array<Scheme, 3> schemes{Scheme::eight, Scheme::four, Scheme::two};
    for (int step = 0; step < 8; ++step) {
        Selection selection;
        selection.random = RandomShare{random() % 3 == 0 ? 0.2 : 0.004, random()};
        const Tuning tuning{.incremental_below = random() % 3 == 0 ? 0.0 : 1.0};
        loop.refine(selection, {.scheme = schemes[random() % 3]}, tuning);
        const CanonicalOrder order(loop.mesh());
        expect_equal(with_interfaces(input_of(loop.mesh()), input), input);
        const std::vector<CutRuns> steps = steps_of(loop.mesh());
        for (const double incremental_below : {0.0, 1.0}) {
            DistributedMesh again = with_interfaces(input_of(loop.mesh()), input);
            replay(again, cut_roots_of(steps, loop.mesh().cell_ancestors.first), steps.size(),
                   {.incremental_below = incremental_below});
            restore_canonical_order(again);
            expect_equal(again, loop.mesh());
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Replay, testing::Range<std::uint64_t>(0, 6));

}  // namespace
}  // namespace octetra::distributed
