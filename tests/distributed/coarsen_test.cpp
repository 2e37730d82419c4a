#include <gtest/gtest.h>

#include <octetra/distributed/partition.hpp>

#include "distributed/loop.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/reference_steps.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"

/// Compares coarsening by the engine with that by the reference, step by step.
namespace octetra::distributed {
namespace {

/// Collective. Applies the same steps to both.
class Both {
public:
    explicit Both(const Mesh& mesh, std::uint64_t seed)
        : reference_(mesh),
          engine_{distribute(test::world(), mesh,
                             partition_cells(mesh, test::world().size(),
                                             parse_partition("random:" + std::to_string(seed))))} {}

    void refine(const Selection& selection, Scheme scheme, const Tuning& tuning) {
        engine_.refine(selection, {.scheme = scheme}, tuning);
        reference_.refine(selection, scheme);
    }
    void coarsen(const Selection& selection, const Tuning& tuning) {
        engine_.coarsen(selection, tuning);
        reference_.coarsen(selection);
    }
    void expect_equal() const {
        const Mesh found = collect_copy(engine_.mesh()).mesh;
        const std::uint64_t steps = engine_.mesh().level_begin.size();
        EXPECT_EQ(test::world().max(steps), steps);
        if (!test::world().is_first()) return;
        EXPECT_EQ(steps, reference_.history().steps.size());
        EXPECT_EQ(found.cells.size(), reference_.mesh().cells.size());
        EXPECT_TRUE(found == reference_.mesh());
    }
    [[nodiscard]] const DistributedMesh& mesh() const { return engine_.mesh(); }
    [[nodiscard]] const reference::History& history() const { return reference_.history(); }

private:
    test::ReferenceSteps reference_;
    test::Loop engine_;
};

double random_share(std::mt19937_64& random) {
    return std::uniform_real_distribution<double>()(random);
}

class Coarsening : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Coarsening, IsTheReferencesStepByStep) {
    std::mt19937_64 random(GetParam());
    const bool has_ties = GetParam() % 2 == 0;
    const Mesh lattice = has_ties ? test::kuhn(3, 3, 3) : test::perturbed_kuhn(3, 0.2, GetParam());
    Both both(test::marked(lattice, 1), GetParam());
    constexpr std::array<Scheme, 3> schemes{Scheme::eight, Scheme::four, Scheme::two};
    for (int step = 0; step < 8; ++step) {
        Selection selection;
        constexpr std::array<double, 4> shares{0.004, 0.1, 0.5, 0.95};
        selection.random = RandomShare{shares[random() % 4], random()};
        constexpr std::array<double, 3> roots_below{0.25, 1, 1};
        const Tuning tuning{.incremental_below = random() % 4 == 0 ? 0.0 : 2.0,
                            .roots_below = roots_below[random() % 3]};
        const Scheme scheme = schemes[random() % 3];
        if (step >= 2 && random() % 2 == 0) {
            both.coarsen(random() % 8 == 0 ? Selection{.all = true} : selection, tuning);
        } else {
            selection.random->fraction /= 5;
            both.refine(selection, scheme, tuning);
        }
        both.expect_equal();
    }
}

/// The lists stay unordered throughout, and the maps that locate their entities are kept up to
/// date.
TEST_P(Coarsening, OfFewCellsRepeatedlyEqualsTheReference) {
    std::mt19937_64 random(GetParam());
    Both both(test::marked(test::perturbed_kuhn(3, 0.2, GetParam()), 1), GetParam());
    const Tuning incremental{.incremental_below = 2, .roots_below = 1};
    both.refine({.random = RandomShare{0.2, GetParam()}}, Scheme::eight, {.incremental_below = 0});
    both.refine({.spheres = {{{1.5, 1.5, 1.5}, 0.3}}}, Scheme::eight, incremental);
    for (int step = 0; step < 8; ++step) {
        Selection selection;
        const double share = random() % 2 == 0 ? 0.003 : 0.05;
        if (step % 2 == 0) {
            selection.random = RandomShare{share / 3, random()};
            both.refine(selection, step % 4 == 0 ? Scheme::two : Scheme::eight, incremental);
        } else {
            const Point centre{3 * random_share(random), 3 * random_share(random), 1.5};
            selection.spheres.push_back({centre, 1});
            both.coarsen(selection, incremental);
        }
        both.expect_equal();
    }
    EXPECT_NE(both.mesh().adjacency, nullptr);
}

TEST_P(Coarsening, OfAllRepeatedlyRestoresTheInput) {
    const Mesh mesh = test::marked(test::perturbed_kuhn(2, 0.2, GetParam()), 1);
    Both both(mesh, GetParam());
    for (std::uint64_t step = 0; step < 3; ++step) {
        both.refine({.random = RandomShare{0.2, GetParam() + step}}, Scheme::eight, {});
    }
    for (int step = 0; step < 3; ++step) {
        both.coarsen({.all = true}, {});
        both.expect_equal();
    }
    EXPECT_TRUE(both.history().steps.empty());
    const Mesh found = collect_copy(both.mesh()).mesh;
    EXPECT_TRUE(found == mesh || !test::world().is_first());
}

class CoarseningOfSmallMeshes : public Coarsening {};

/// Several levels at once: often only another process knows that an edge is bisected.
TEST_P(CoarseningOfSmallMeshes, OfAllButFewCellsEqualsTheReference) {
    std::mt19937_64 random(GetParam());
    const int trials = test::world().size() > 3 ? 2 : 20;
    for (int trial = 0; trial < trials; ++trial) {
        const Mesh lattice =
            trial % 2 == 0 ? test::kuhn(2, 1, 1) : test::perturbed_kuhn(2, 0.2, random());
        Both both(lattice, random());
        for (int step = 0; step < 3; ++step) {
            both.refine({.random = RandomShare{0.08, random()}}, Scheme::eight, {});
        }
        both.coarsen({.random = RandomShare{trial % 3 == 0 ? 0.9 : 0.98, random()}}, {});
        both.expect_equal();
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Coarsening, testing::Range<std::uint64_t>(0, 10));
INSTANTIATE_TEST_SUITE_P(Seeds, CoarseningOfSmallMeshes, testing::Range<std::uint64_t>(0, 16));

}  // namespace
}  // namespace octetra::distributed
