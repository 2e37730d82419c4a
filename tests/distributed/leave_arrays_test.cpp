#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/adaptive_steps.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/thrown.hpp"

/// Arrays that a program keeps reading, and work without communication.
namespace octetra::distributed {
namespace {

/// A span, and its contents at construction.
template <class T>
struct Seen {
    std::span<const T> span;
    std::vector<T> values{span.begin(), span.end()};

    [[nodiscard]] bool is_as_it_was() const { return std::ranges::equal(span, values); }
};
template <class T>
Seen(std::span<const T>) -> Seen<T>;

TEST_P(AdaptiveMeshIn, LeavesArraysInUseUnchangedAndContinuesNormally) {
    const Mesh input = test::marked(test::perturbed_kuhn(5, 0.2, 2), 2);
    AdaptiveMesh mesh = distributed_mesh(input, GetParam());
    AdaptiveMesh expected = distributed_mesh(input, GetParam());
    std::vector<DetachedArrays> left;
    std::vector<std::function<bool()>> checks;
    const auto look = [&] {
        const auto check = [&](auto span) {
            checks.push_back([seen = Seen{span}] { return seen.is_as_it_was(); });
        };
        check(mesh.points());
        check(mesh.cells());
        check(mesh.facets());
        check(mesh.edges());
        check(mesh.vertex_numbers());
        check(mesh.roots());
        left.push_back(mesh.detach_arrays({true, true, true, true, true, true}));
    };
    for (const Selection& selection : steps) {
        look();
        (void)mesh.refine(selection);
        (void)expected.refine(selection);
        EXPECT_EQ(mesh.collect(), expected.collect());
    }
    const Selection ball{.spheres = {{{0.5, 0.5, 0.5}, 0.4}}};
    look();
    (void)mesh.coarsen(ball);
    (void)expected.coarsen(ball);
    look();
    (void)mesh.rebalance({.most_over_mean = 1.0});
    EXPECT_EQ(mesh.collect(), expected.collect());
    for (std::size_t i = 0; i < checks.size(); ++i) EXPECT_TRUE(checks[i]()) << i;
}

TEST_P(AdaptiveMeshIn, LeavesOnlyArraysThatAreInUse) {
    AdaptiveMesh mesh =
        distributed_mesh(test::marked(test::perturbed_kuhn(3, 0.2, 2), 2), GetParam());
    const Point* const points = mesh.points().data();
    const CellVertices* const cells = mesh.cells().data();
    const DetachedArrays left = mesh.detach_arrays({.cells = true});
    EXPECT_EQ(left.cells.data(), cells);
    EXPECT_NE(mesh.cells().data(), cells);
    EXPECT_EQ(mesh.points().data(), points);
    EXPECT_TRUE(left.points.empty());
}

TEST(OnEach, ThrowsTheErrorOfTheLowestFailedRankOnAll) {
    const Communicator& world = test::world();
    int runs = 0;
    world.transaction([&] { ++runs; });
    EXPECT_EQ(runs, 1);
    const int last = world.size() - 1;
    const auto fail_from = [&](int first) {
        world.transaction([&] {
            if (world.rank() >= first) throw InputError(std::to_string(world.rank()));
        });
    };
    EXPECT_EQ(test::thrown_by<InputError>([&] { fail_from(last); }), std::to_string(last));
    EXPECT_EQ(test::thrown_by<InputError>([&] { fail_from(last / 2); }), std::to_string(last / 2));
}

}  // namespace
}  // namespace octetra::distributed
