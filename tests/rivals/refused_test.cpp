#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "rivals/terminal_edges.hpp"
#include "support/manifest.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Impossible requests are reported, and every run ends.
namespace octetra::rivals {
namespace {

std::string refusal(const Mesh& mesh, const Goal& goal, std::size_t max_cells = 1U << 20U) {
    return test::thrown_by<InputError>([&] {
        TerminalEdgeBisection bisection(mesh);
        (void)bisection.refine(goal, max_cells);
    });
}

TEST(Refused, AreThreeCellsAtAFace) {
    Mesh at_a_face = read_mesh(test::corpus_folder() / "meshes/two-on-a-face.ele");
    at_a_face.cells.push_back(at_a_face.cells.front());
    EXPECT_EQ(refusal(at_a_face, {}), "three cells have a face in common");
}

TEST(Refused, AreGoalsThatMakeNoSense) {
    const Mesh mesh = test::kuhn(1, 1, 1);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(mesh, {.targets = {1, 0}}), testing::HasSubstr("number of cells"));
    for (const double length : {0.0, nan, 1e-200, std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(refusal(mesh, {.longest_edge = length}), testing::HasSubstr("no square"));
    }
    for (const double volume : {0.0, -1.0, nan}) {
        EXPECT_EQ(refusal(mesh, {.volume = volume}), "a goal has no volume");
    }
}

TEST(Refused, AreCellsBeyondTheirNumberThatIsAllowed) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    EXPECT_EQ(refusal(mesh, {.volume = 1e-9}, 1000), "there would be too many cells");
    EXPECT_EQ(TerminalEdgeBisection(mesh).refine({}, 2 * mesh.cells.size()).cells_cut,
              mesh.cells.size());
}

TEST(Refused, AreMidpointsThatRoundingMakesUseless) {
    const Mesh mesh = read_mesh(test::corpus_folder() / "meshes/no-room-for-midpoints.ele");
    EXPECT_THAT(refusal(mesh, {}), testing::HasSubstr("would flatten or invert"));
    const Mesh cube = test::kuhn(1, 1, 1);  // until coordinates have no more bits
    Mesh far = cube;
    for (Point& p : far.points) p = {p.x + 0x1p50, p.y + 0x1p50, p.z + 0x1p50};
    EXPECT_THAT(refusal(far, {.volume = 1e-9}), testing::HasSubstr("would flatten or invert"));
}

TEST(Refused, IsNothingWhereThereAreNoCells) {
    TerminalEdgeBisection bisection(Mesh{});
    EXPECT_TRUE(bisection.refine({}).edges_bisected.empty());
    EXPECT_TRUE(bisection.result().mesh.cells.empty());
}

}  // namespace
}  // namespace octetra::rivals
