#include <array>
#include <cstdint>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/loop.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/reference_steps.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// Refinement with Closure::regular.
namespace octetra::distributed {
namespace {

constexpr StepOptions regular{.closure = Closure::regular};

AdaptiveMesh mesh_in_parts(const Mesh& mesh, const std::string& partition) {
    return AdaptiveMesh::distribute(
        test::world(), mesh,
        partition_cells(mesh, test::world().size(), parse_partition(partition)));
}

Selection cells_at_random(double share, std::uint64_t seed) {
    return {.random = RandomShare{share, seed}};
}

class RegularMesh : public testing::TestWithParam<std::uint64_t> {
protected:
    const std::uint64_t seed = GetParam();
    const Mesh input =
        test::marked(seed % 2 == 0 ? test::kuhn(2, 2, 1) : test::perturbed_kuhn(2, 0.2, seed), 1);
    AdaptiveMesh mesh = mesh_in_parts(input, seed % 3 == 0 ? "block" : "random:3");
    std::mt19937_64 random{seed};

    double random_share() {
        constexpr std::array<double, 3> shares{0.02, 0.1, 0.4};
        return shares[random() % 3];
    }
};

TEST_P(RegularMesh, IsTheReferencesAfterRandomStepsOnEveryPartition) {
    test::ReferenceSteps reference(input);
    for (int k = 0; k < 7; ++k) {
        const bool refines = k < 2 || random() % 4 != 0;
        const Selection selection = cells_at_random(refines ? random_share() : 0.9, random());
        const Adaptation step = refines ? mesh.refine(selection, regular) : mesh.coarsen(selection);
        if (refines) {
            reference.refine_regularly(selection);
        } else {
            reference.coarsen(selection, Closure::regular);
        }
        EXPECT_EQ(step.vertex_count(), mesh.points().size());
        const Mesh found = mesh.collect();
        if (!test::world().is_first()) continue;
        ASSERT_TRUE(found == reference.mesh()) << "step " << k;
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            const auto number = static_cast<std::size_t>(mesh.vertex_numbers()[v]);
            ASSERT_TRUE(found.points.at(number) == mesh.points()[v]);
        }
    }
}

/// Linear functions are exact, and so is the mass of a piecewise constant one.
TEST_P(RegularMesh, TransfersValues) {
    const auto volume_of = [&](std::size_t c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh.points()[mesh.cells()[c][k].value()];
        }
        return volume(corners);
    };
    for (int k = 0; k < 5; ++k) {
        std::vector<double> x;
        for (const Point& p : mesh.points()) x.insert(x.end(), {p.x, p.y, p.z});
        std::vector<double> mass;
        std::vector<double> density;
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
            density.push_back(1 + static_cast<double>(c % 5));
            mass.push_back(density.back() * volume_of(c));
        }
        const Adaptation step = mesh.refine(cells_at_random(random_share(), random()), regular);
        x = step.transfer_vertices(std::move(x), 3);
        ASSERT_EQ(x.size(), 3 * mesh.points().size());
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            EXPECT_EQ((Point{x[3 * v], x[3 * v + 1], x[3 * v + 2]}), mesh.points()[v]);
        }
        mass = step.transfer_cells(std::move(mass), 1, CellValues::divided);
        density = step.transfer_cells(std::move(density));
        ASSERT_EQ(mass.size(), mesh.cells().size());
        for (std::size_t c = 0; c < mass.size(); ++c) {
            EXPECT_NEAR(mass[c], density[c] * volume_of(c), 1e-12);
        }
        EXPECT_EQ(step.facets.parents().size(), mesh.facets().size());
        EXPECT_EQ(step.edges.parents().size(), mesh.edges().size());
    }
}

TEST_P(RegularMesh, ContinuesAfterMigrationAsWithoutIt) {
    AdaptiveMesh still = mesh_in_parts(input, "block");
    for (int k = 0; k < 4; ++k) {
        const Selection selection = cells_at_random(random_share(), random());
        (void)mesh.refine(selection, regular);
        (void)still.refine(selection, regular);
        std::vector<int> ranks;
        for (const std::uint64_t root : mesh.roots()) {
            ranks.push_back(static_cast<int>((root * 7 + seed + static_cast<std::uint64_t>(k)) %
                                             static_cast<std::uint64_t>(test::world().size())));
        }
        (void)mesh.migrate(ranks);
        const Mesh moved = mesh.collect();
        EXPECT_TRUE(moved == still.collect());
    }
}

TEST_P(RegularMesh, ContinuesFromACheckpointAsWithoutIt) {
    const test::SharedFolder folder;
    mesh = mesh_in_parts(test::tagged(test::perturbed_kuhn(2, 0.2, seed)), "random:3");
    const auto path = folder / "state.octetra";
    for (int k = 0; k < 3; ++k) {
        const Selection selection = cells_at_random(random_share(), random());
        (void)mesh.refine(selection, regular);
        mesh.save(path);
        AdaptiveMesh loaded = AdaptiveMesh::load(test::world(), path);
        EXPECT_TRUE(loaded.collect() == mesh.collect());
        const Selection next = cells_at_random(random_share(), random());
        EXPECT_EQ(loaded.refine(next, regular).changed, mesh.refine(next, regular).changed);
        EXPECT_TRUE(loaded.collect() == mesh.collect());
        EXPECT_EQ(loaded.coarsen(next).changed, mesh.coarsen(next).changed);
        EXPECT_TRUE(loaded.collect() == mesh.collect());
        EXPECT_THROW((void)loaded.refine({.all = true}, StepOptions{}), InputError);
    }
}

/// The kind of each level is determined by this process's own part.
Tuning random_tuning(std::mt19937_64& random) {
    constexpr std::array<double, 4> fractions{0, 0.0625, 0.5, 10};
    return {.incremental_below =
                fractions[(random() + static_cast<std::uint64_t>(test::world().rank())) % 4]};
}

/// Everything that a failing step must restore.
struct Lists {
    std::vector<Point> points;
    std::vector<double> attributes;
    std::vector<VertexIndex> level_begin;
    std::vector<EdgeVertices> midpoint_to_edge;
    std::vector<CellVertices> cells;
    std::vector<FacetVertices> facets;
    std::vector<EdgeVertices> edges;
    std::vector<std::vector<EdgeVertices>> shared_edges;
    std::vector<std::vector<FacetVertices>> shared_faces;
    std::vector<GlobalVertex> numbers;
    Sharing<VertexIndex> sharing;
    TransitionCells::Kinds kinds;
    Mesh whole;

    explicit Lists(const test::Loop& loop)
        : points(loop.mesh().points),
          attributes(loop.mesh().point_attributes),
          level_begin(loop.mesh().level_begin),
          midpoint_to_edge(loop.mesh().midpoint_to_edge),
          cells(loop.mesh().cells),
          facets(loop.mesh().facets),
          edges(loop.mesh().edges),
          numbers(loop.state().numbers.of_vertex),
          sharing(loop.state().sharing),
          kinds(loop.state().transition_kinds),
          whole(collect_copy(loop.mesh()).mesh) {
        for (const Interface& interface : loop.mesh().interfaces) {
            shared_edges.push_back(interface.edges);
            shared_faces.push_back(interface.faces);
        }
    }
    friend bool operator==(const Lists&, const Lists&) = default;
};

TEST_P(RegularMesh, IsTheReferencesWithEveryKindOfLevelAndAsItWasAfterFailingSteps) {
    test::ReferenceSteps reference(input);
    test::Loop loop(
        distribute(test::world(), input,
                   partition_cells(input, test::world().size(), parse_partition("random:3"))));
    std::uint64_t failures = 0;
    for (int k = 0; k < 8; ++k) {
        const Tuning tuning = random_tuning(random);
        const std::uint64_t count = test::world().sum(loop.mesh().cells.size());
        const bool refines = k < 2 || (random() % 5 != 0 && count < 2000);
        const Selection selection = cells_at_random(refines ? random_share() / 2 : 0.9, random());
        if (refines) {
            const Lists before(loop);
            const StepOptions few{.closure = Closure::regular, .max_cells = count + random() % 400};
            try {
                (void)loop.refine(selection, few, random_tuning(random));
            } catch (const InputError&) {
                ++failures;
                EXPECT_TRUE(before == Lists(loop)) << "step " << k;
                (void)loop.refine(selection, regular, tuning);
            }
            reference.refine_regularly(selection);
        } else {
            (void)loop.coarsen(selection, tuning);
            reference.coarsen(selection, Closure::regular);
        }
        const Mesh found = collect_copy(loop.mesh()).mesh;
        if (test::world().is_first()) {
            ASSERT_TRUE(found == reference.mesh()) << "step " << k;
        }
        const CanonicalNumbers numbers = canonical_numbers(loop.mesh());
        EXPECT_EQ(loop.state().numbers.of_vertex, numbers.of_vertex);
        EXPECT_EQ(loop.state().numbers.vertex_count, numbers.vertex_count);
    }
    EXPECT_GT(failures, 1U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RegularMesh,
                         testing::Range<std::uint64_t>(0, OCTETRA_SANITIZED ? 2 : 4));

/// Marks the cell with this number in the whole mesh, modulo the number of cells.
std::vector<std::uint8_t> mark_of(const AdaptiveMesh& mesh, std::uint64_t number) {
    std::vector<std::uint8_t> marks;
    for (const std::uint64_t c : mesh.cell_numbers()) marks.push_back(c == number ? 1 : 0);
    return marks;
}

/// Two cells of similar or of different size with a common face.
class TwoCells : public testing::TestWithParam<double> {
protected:
    const Mesh input = test::mesh_of(
        {{0, 0, 0}, {1, 0.1, 0}, {0.2, 0.9, 0.1}, {0.3, 0.2, 0.8}, {0.4, GetParam(), -0.7}},
        {{0, 1, 2, 3}, {0, 2, 1, 4}});
};

/// Every cell is marked in every mesh that two marked cells in turn can lead to; on two ranks, and
/// with sanitizers, every fifth.
TEST_P(TwoCells, AreRefinedAsByTheReferenceInEverySequenceOfThreeMarks) {
    if (test::world().size() > 2) GTEST_SKIP() << "two cells are on at most two ranks";
    const auto refine = [&](const std::vector<std::uint64_t>& cells) {
        AdaptiveMesh mesh = mesh_in_parts(input, "block");
        for (const std::uint64_t c : cells) (void)mesh.refine(mark_of(mesh, c), regular);
        return mesh;
    };
    const auto count = [](const AdaptiveMesh& mesh) {
        return mesh.processes().sum(mesh.cells().size());
    };
    const std::uint64_t stride = test::world().size() > 1 || OCTETRA_SANITIZED ? 5 : 1;
    std::uint64_t compared = 0;
    for (std::uint64_t a = 0; a < 2; ++a) {
        const std::uint64_t after_one = count(refine({a}));
        for (std::uint64_t b = 0; b < after_one; ++b) {
            const std::uint64_t after_two = count(refine({a, b}));
            for (std::uint64_t c = b % stride; c < after_two; c += stride) {
                const Mesh found = refine({a, b, c}).collect();
                if (!test::world().is_first()) continue;
                reference::History history{input, {}};
                for (const std::uint64_t cell : {a, b, c}) {
                    const auto present = reference::replay(history).back();
                    reference::CellMarks marks(present.mesh.cells.size(), false);
                    marks[CellIndex{cell}] = true;
                    history = reference::refined_regularly(history, marks);
                }
                ASSERT_TRUE(found == reference::replay(history).back().mesh)
                    << a << ", " << b << ", " << c;
                ++compared;
            }
        }
    }
    if (test::world().is_first()) {
        EXPECT_GT(stride * compared, 300U);
    }
}

INSTANTIATE_TEST_SUITE_P(Places, TwoCells, testing::Values(0.5, 3.0));

TEST(RegularMesh, RefusesOtherSchemesAndAnotherClosureByName) {
    AdaptiveMesh mesh = mesh_in_parts(test::kuhn(1, 1, 1), "block");
    EXPECT_EQ(test::thrown_by<InputError>([&] {
                  (void)mesh.refine(cells_at_random(0.5, 1),
                                    {.scheme = Scheme::four, .closure = Closure::regular});
              }),
              "the regular closure requires the scheme 8t");
    (void)mesh.refine({.all = true}, regular);
    const test::ObservedMesh before(mesh);
    EXPECT_EQ(test::thrown_by<InputError>([&] { (void)mesh.refine({.all = true}, StepOptions{}); }),
              "the mesh was refined with the regular closure, and this step has the longest-edge "
              "closure: repeat the step with the closure of the mesh");
    EXPECT_EQ(test::thrown_by<InputError>([&] {
                  (void)mesh.refine({.all = true}, {.closure = Closure::regular, .max_cells = 100});
              }),
              "the step would make more than the 100 cells allowed: mark fewer cells, or allow "
              "more");
    EXPECT_TRUE(before == test::ObservedMesh(mesh));
}

/// Cells have migrated when the step is found to be too large.
TEST(RegularMesh, IsAsItWasAfterAFailingEvenStep) {
    const Mesh input = test::kuhn(2, 2, 2);
    AdaptiveMesh mesh =
        AdaptiveMesh::distribute(test::world(), input, std::vector<int>(input.cells.size(), 0));
    (void)mesh.refine(cells_at_random(0.2, 1), regular);
    const test::ObservedMesh before(mesh);
    StepOptions few = regular;
    few.max_cells = test::world().sum(mesh.cells().size()) + 1;
    EXPECT_THROW((void)mesh.refine_evenly(Selection{.all = true}, {}, few), InputError);
    EXPECT_TRUE(before == test::ObservedMesh(mesh));
    EXPECT_TRUE(mesh.refine_evenly(Selection{.all = true}, {}, regular).step.changed);
    EXPECT_GT(mesh.cells().size(), 0U);
}

TEST(RegularMesh, OfTheInputCanBeRefinedWithAnyClosure) {
    AdaptiveMesh mesh = mesh_in_parts(test::kuhn(1, 1, 1), "block");
    (void)mesh.refine({.all = true}, regular);
    (void)mesh.coarsen(Selection{.all = true});
    EXPECT_TRUE(mesh.refine({.all = true}, StepOptions{}).changed);
}

}  // namespace
}  // namespace octetra::distributed
