#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// A refused step leaves the mesh unchanged.
namespace octetra::distributed {
namespace {

TEST_P(AdaptiveMeshIn, IsAsItWasAfterAStepThatIsRefused) {
    const auto& world = test::world();
    const bool is_last = world.rank() == world.size() - 1;
    AdaptiveMesh mesh =
        distributed_mesh(test::marked(test::perturbed_kuhn(3, 0.2, 1), 1), GetParam());
    for (const Selection& selection : {steps[0], steps[2], steps[0]}) {
        const test::ObservedMesh before(mesh);
        auto marks = marks_of(mesh, {.all = true});
        if (is_last) marks.push_back(1);
        const auto words = test::thrown_by<InputError>([&] { (void)mesh.refine(marks); });
        EXPECT_THAT(words, testing::StartsWith(fmt::format("rank {}: ", world.size() - 1)));
        std::vector<CellIndex> listed;
        if (is_last) listed.push_back(CellIndex{mesh.cells().size()});
        EXPECT_THROW((void)mesh.refine(listed), InputError);
        std::vector<EdgeVertices> no_edges;
        if (is_last) no_edges.push_back({VertexIndex{0}, VertexIndex{mesh.points().size()}});
        EXPECT_THROW((void)mesh.refine_edges(no_edges), InputError);
        EXPECT_THROW((void)mesh.refine(selection, {.max_cells = 10}), InputError);
        if (world.size() > 1) {
            StepOptions other;
            if (is_last) other.scheme = Scheme::two;
            EXPECT_EQ(
                test::thrown_by<InputError>([&] { (void)mesh.refine(selection, other); }),
                fmt::format("rank {}: the scheme is 2t, and 8t on rank 0: all ranks must pass the "
                            "same",
                            world.size() - 1));
            other = {};
            if (is_last) other.max_cells = 10;  // alone it would need the number of all cells
            EXPECT_EQ(
                test::thrown_by<InputError>(
                    [&] { (void)mesh.refine(marks_of(mesh, selection), other); }),
                fmt::format("rank {}: the max_cells is 10, and 18446744073709551615 on rank 0: "
                            "all ranks must pass the same",
                            world.size() - 1));
        }
        const Selection negative{.all = true, .spheres = {{{0, 0, 0}, -1}}};
        const auto refused = [&](auto&& step) { return test::thrown_by<InputError>(step); };
        const std::string negative_radius = "sphere: the radius is negative: 0,0,0,-1";
        EXPECT_EQ(refused([&] { (void)mesh.refine(negative); }), negative_radius);
        EXPECT_EQ(refused([&] { (void)mesh.refine_evenly(negative); }), negative_radius);
        EXPECT_EQ(refused([&] { (void)mesh.coarsen(negative); }), negative_radius);
        EXPECT_TRUE(before == test::ObservedMesh(mesh));
        EXPECT_FALSE(mesh.refine(Selection{}).changed);
        EXPECT_TRUE(before == test::ObservedMesh(mesh));
        (void)mesh.refine(selection);
    }
}

TEST_P(AdaptiveMeshIn, IsAsItWasAfterAStepThatOneProcessCannotAskFor) {
    const auto& world = test::world();
    const bool is_last = world.rank() == world.size() - 1;
    AdaptiveMesh mesh =
        distributed_mesh(test::marked(test::perturbed_kuhn(3, 0.2, 1), 1), GetParam());
    AdaptiveMesh other =
        distributed_mesh(test::marked(test::perturbed_kuhn(3, 0.2, 1), 1), GetParam());
    for (const Selection& selection : {steps[0], Selection{.all = true}, steps[2]}) {
        const test::ObservedMesh before(mesh);
        const auto marks = marks_of(mesh, selection);
        const auto request = [&](bool has_failed) {
            if (has_failed) throw InputError("nothing to mark by");
            return StepRequest{marks, {.scheme = Scheme::four}};
        };
        EXPECT_EQ(test::thrown_by<InputError>(
                      [&] { (void)mesh.refine([&] { return request(is_last); }); }),
                  "nothing to mark by");
        EXPECT_TRUE(before == test::ObservedMesh(mesh));
        (void)mesh.refine([&] { return request(false); });
        (void)other.refine(marks, {.scheme = Scheme::four});
        EXPECT_TRUE(test::ObservedMesh(other) == test::ObservedMesh(mesh));
    }
}

TEST_P(AdaptiveMeshIn, IsAsItWasAfterAStepThatRoundingForbids) {
    // At this distance only whole numbers are representable: after some levels an edge has no
    // midpoint.
    Mesh whole = test::kuhn(3, 3, 3, 8);
    for (Point& p : whole.points) p = {p.x + 0x1p52, p.y + 0x1p52, p.z + 0x1p52};
    const Selection corner{
        .boxes = {{{0x1p52, 0x1p52, 0x1p52}, {0x1p52 + 8, 0x1p52 + 8, 0x1p52 + 8}}}};
    for (const Selection& selection : {corner, Selection{.all = true}}) {
        AdaptiveMesh mesh = distributed_mesh(whole, GetParam());
        int steps_taken = 0;
        while (true) {
            const test::ObservedMesh before(mesh);
            try {
                (void)mesh.refine(selection);
                ++steps_taken;
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), testing::HasSubstr("midpoints"));
                EXPECT_TRUE(before == test::ObservedMesh(mesh));
                break;
            }
        }
        EXPECT_GE(steps_taken, 1);
    }
}

TEST_P(AdaptiveMeshIn, IsAsItWasAfterAStepThatChangesMuchAndIsRefusedAfterOneThatChangedLittle) {
    // Incremental levels leave the lists unordered, and a full sweep needs the canonical order.
    AdaptiveMesh mesh =
        distributed_mesh(test::marked(test::perturbed_kuhn(6, 0.2, 1), 1), GetParam());
    for (const Selection& small : {steps[0], steps[1], steps[3]}) {
        (void)mesh.refine(small);
        const test::ObservedMesh before(mesh);
        const auto cells = test::world().sum(mesh.cells().size());
        EXPECT_THROW((void)mesh.refine(Selection{.all = true}, {.max_cells = cells}), InputError);
        EXPECT_TRUE(before == test::ObservedMesh(mesh));
    }
}

}  // namespace
}  // namespace octetra::distributed
