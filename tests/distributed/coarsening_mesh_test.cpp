#include <algorithm>
#include <complex>
#include <map>
#include <random>
#include <span>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/observed_mesh.hpp"
#include "distributed/reference_steps.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// Tests of AdaptiveMesh::coarsen and the Adaptation that it returns.
namespace octetra::distributed {
namespace {

AdaptiveMesh distributed_mesh(const Mesh& mesh, const std::string& partition) {
    return AdaptiveMesh::distribute(
        test::world(), mesh,
        partition_cells(mesh, test::world().size(), parse_partition(partition)));
}

Selection some(double share, std::uint64_t seed) { return {.random = RandomShare{share, seed}}; }

class CoarseningMesh : public testing::TestWithParam<std::uint64_t> {};

/// Few or many cells, refined and coarsened: full sweeps and incremental levels.
std::vector<std::pair<bool, Selection>> random_steps(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<std::pair<bool, Selection>> steps{{true, some(0.1, seed)}};
    for (int k = 0; k < 7; ++k) {
        const bool refines = random() % 2 == 0;
        constexpr std::array<double, 3> shares{0.002, 0.05, 0.9};
        steps.emplace_back(refines, some(shares[random() % (refines ? 2 : 3)], random()));
    }
    return steps;
}

TEST_P(CoarseningMesh, IsTheReferencesOnEveryPartition) {
    const Mesh input = test::marked(test::perturbed_kuhn(4, 0.2, GetParam()), 1);
    AdaptiveMesh mesh = distributed_mesh(input, GetParam() % 2 == 0 ? "block" : "random:3");
    test::ReferenceSteps reference(input);
    for (const auto& [refines, selection] : random_steps(GetParam())) {
        const Adaptation step = refines ? mesh.refine(selection) : mesh.coarsen(selection);
        const reference::History before = reference.history();
        if (refines) {
            reference.refine(selection);
        } else {
            reference.coarsen(selection);
        }
        const Mesh found = mesh.collect();
        EXPECT_EQ(mesh.vertex_count(), test::world().sum(found.points.size()));
        if (!test::world().is_first()) continue;
        EXPECT_EQ(step.changed, reference.history().steps != before.steps);
        EXPECT_TRUE(found == reference.mesh());
        // These are maintained by the steps, not recomputed as in collect().
        for (std::size_t v = 0; v < mesh.points().size(); ++v) {
            const auto number = static_cast<std::size_t>(mesh.vertex_numbers()[v]);
            ASSERT_TRUE(found.points.at(number) == mesh.points()[v]);
        }
    }
}

/// The data that the mesh reports for each vertex and cell, keyed by coordinates.
TEST_P(CoarseningMesh, HasNumbersSharersAndOwnersOfAMeshThatWasNeverFiner) {
    const Mesh input = test::marked(test::perturbed_kuhn(3, 0.2, GetParam()), 1);
    AdaptiveMesh mesh = distributed_mesh(input, "random:5");
    (void)mesh.refine(some(0.1, GetParam()));
    const test::ObservedMesh before(mesh);
    (void)mesh.refine(some(0.3, GetParam() + 1));
    for (int k = 0; k < 2; ++k) (void)mesh.coarsen({.all = true});
    (void)mesh.refine(some(0.1, GetParam()));
    EXPECT_TRUE(before == test::ObservedMesh(mesh));
}

TEST_P(CoarseningMesh, KeepsValuesOfVerticesAndComputesThoseOfCellsFromTheirChildren) {
    const Mesh input = test::marked(test::perturbed_kuhn(3, 0.2, GetParam()), 1);
    AdaptiveMesh mesh = distributed_mesh(input, "random:5");
    for (const std::uint64_t k : {0U, 1U, 2U}) (void)mesh.refine(some(0.02, GetParam() + k));
    const auto cell_volume = [&](std::size_t c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh.points()[mesh.cells()[c][k].value()];
        }
        return volume(corners);
    };
    std::vector<double> x;
    for (const Point& p : mesh.points()) x.insert(x.end(), {p.x, p.y, p.z});
    std::vector<double> density;
    std::vector<double> mass;
    double total = 0;
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        density.push_back(static_cast<double>(c % 7));
        mass.push_back(density.back() * cell_volume(c));
        total += mass.back();
    }
    const std::vector<double> before = density;
    const std::vector<double> ones(mesh.cells().size(), 1);
    const Adaptation step = mesh.coarsen(some(0.9, GetParam()));
    ASSERT_TRUE(step.changed && step.is_coarser());
    x = step.transfer_vertices(std::move(x), 3);
    density = step.transfer_cells(std::move(density), 1, CellValues::averaged);
    mass = step.transfer_cells(std::move(mass), 1, CellValues::divided);
    ASSERT_EQ(density.size(), mesh.cells().size());
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        EXPECT_EQ((Point{x[3 * v], x[3 * v + 1], x[3 * v + 2]}), mesh.points()[v]);
    }
    double kept = 0;
    for (std::size_t c = 0; c < mass.size(); ++c) {
        kept += mass[c];
        EXPECT_NEAR(density[c] * cell_volume(c), mass[c], 1e-12);
    }
    EXPECT_NEAR(kept, total, 1e-9);
    EXPECT_EQ(density, step.transfer_cells(before, 1));  // the default is the mean by volume
    const auto means = step.transfer_cells(ones);
    const auto weighted = step.transfer_cells(ones, 1, CellValues::averaged);
    for (std::size_t c = 0; c < means.size(); ++c) {
        EXPECT_EQ(means[c], 1);
        EXPECT_EQ(weighted[c], 1);
    }
}

TEST(MergedValue, IsTheCommonValueOfAllChildrenOrElseTheirMeanInAnyOrder) {
    using distributed::merged_value;
    const auto of = []<class T>(CellValues how, std::vector<distributed::FineValue<T>> pieces) {
        std::vector<T> found;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            std::rotate(pieces.begin(), pieces.begin() + 1, pieces.end());
            auto rotated = pieces;
            found.push_back(merged_value(std::span(rotated), how));
        }
        EXPECT_EQ(std::ranges::count(found, found[0]), std::ssize(found));
        return found[0];
    };
    using Reals = std::vector<distributed::FineValue<double>>;
    using Wholes = std::vector<distributed::FineValue<int>>;
    using Complex = std::complex<double>;
    using Complexes = std::vector<distributed::FineValue<Complex>>;
    EXPECT_EQ(of(CellValues::copied, Reals{{0.1, 1}, {0.1, 2}, {0.1, 2}}), 0.1);
    EXPECT_EQ(of(CellValues::averaged, Reals{{0.1, 1}, {0.1, 2}, {0.1, 2}}), 0.1);
    EXPECT_EQ(of(CellValues::copied, Reals{{3, 1}, {1, 2}, {2, 2}}), 2.25);
    EXPECT_EQ(of(CellValues::averaged, Reals{{8, 1}, {4, 2}, {2, 2}}), 5.5);
    EXPECT_EQ(of(CellValues::divided, Reals{{8, 1}, {4, 2}, {2, 2}}), 14);
    const Complexes complexes{{{8, 1e16}, 1}, {{4, 1}, 2}, {{4, -1e16}, 2}};
    EXPECT_EQ(of(CellValues::copied, complexes).real(), 6);
    EXPECT_EQ(of(CellValues::divided, complexes).real(), 16);
    EXPECT_EQ(of(CellValues::copied, Complexes{{{0.1, 0.3}, 1}, {{0.1, 0.3}, 1}}),
              Complex(0.1, 0.3));
    EXPECT_EQ(of(CellValues::copied, Wholes{{7, 1}, {7, 2}, {7, 2}}), 7);
    EXPECT_EQ(of(CellValues::copied, Wholes{{9, 1}, {-3, 2}, {9, 2}}), 9);
    EXPECT_EQ(of(CellValues::copied, Wholes{{5, 1}, {5, 2}, {4, 2}, {4, 3}, {9, 3}}), 4);
    EXPECT_EQ(of(CellValues::divided, Wholes{{7, 1}, {7, 2}, {-1, 2}}), 13);
}

TEST_P(CoarseningMesh, KeepsWholeNumbersCommonToAllChildren) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, GetParam()), "random:5");
    std::vector<int> tag(mesh.cells().size(), 7);
    std::vector<double> tenth(mesh.cells().size(), 0.1);
    for (const std::uint64_t k : {0U, 1U}) {
        const Adaptation step = mesh.refine(some(0.05, GetParam() + k));
        EXPECT_THROW((void)step.transfer_cells(tag, 1, CellValues::divided), std::invalid_argument);
        EXPECT_THROW((void)step.transfer_vertices(std::vector<int>(step.vertex_count_before)),
                     std::invalid_argument);
        tag = step.transfer_cells(std::move(tag));
        tenth = step.transfer_cells(std::move(tenth));
    }
    const Adaptation step = mesh.coarsen({.all = true});
    ASSERT_TRUE(step.is_coarser());
    EXPECT_THROW((void)step.transfer_cells(tag, 1, CellValues::averaged), std::invalid_argument);
    EXPECT_EQ(step.transfer_cells(tag), std::vector<int>(mesh.cells().size(), 7));
    EXPECT_EQ(step.transfer_cells(tenth), std::vector<double>(mesh.cells().size(), 0.1));
}

TEST_P(CoarseningMesh, MapsEveryFacetAndTaggedEdgeToItsSuccessor) {
    const Mesh input = test::marked(test::perturbed_kuhn(3, 0.2, GetParam()), 1);
    AdaptiveMesh mesh = distributed_mesh(input, "random:5");
    for (const std::uint64_t k : {0U, 1U, 2U}) (void)mesh.refine(some(0.02, GetParam() + k));
    const std::vector<Point> points(mesh.points().begin(), mesh.points().end());
    const std::vector<FacetVertices> facets(mesh.facets().begin(), mesh.facets().end());
    const std::vector<Marker> markers = mesh.facet_markers();
    const std::vector<EdgeVertices> edges(mesh.edges().begin(), mesh.edges().end());
    const Adaptation step = mesh.coarsen(some(0.9, GetParam()));
    ASSERT_EQ(step.facets.coarse_of().size(), facets.size());
    ASSERT_EQ(step.edges.coarse_of().size(), edges.size());
    // A child lies in its parent: its corners are means of the parent's corners.
    const auto area = [](const Point& a, const Point& b, const Point& c) {
        const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
        const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
        return std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    };
    std::vector<double> areas(mesh.facets().size(), 0);
    const std::vector<Marker> markers_after = mesh.facet_markers();
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::uint32_t whole = step.facets.coarse_of()[f];
        EXPECT_EQ(markers[f], markers_after[whole]);
        areas[whole] += area(points[facets[f][0].value()], points[facets[f][1].value()],
                             points[facets[f][2].value()]);
    }
    for (std::size_t f = 0; f < areas.size(); ++f) {
        const auto& [a, b, c] = mesh.facets()[f];
        EXPECT_NEAR(
            areas[f],
            area(mesh.points()[a.value()], mesh.points()[b.value()], mesh.points()[c.value()]),
            1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, CoarseningMesh, testing::Range<std::uint64_t>(0, 8));

TEST(CoarseningByWrongMarks, IsRefusedOnAllProcessesAndChangesNothing) {
    AdaptiveMesh mesh = distributed_mesh(test::perturbed_kuhn(3, 0.2, 1), "block");
    (void)mesh.refine(some(0.1, 1));
    const test::ObservedMesh before(mesh);
    std::vector<std::uint8_t> marks(mesh.cells().size() + (test::world().is_first() ? 1 : 0), 1);
    EXPECT_THROW((void)mesh.coarsen(marks), InputError);
    EXPECT_TRUE(before == test::ObservedMesh(mesh));
}

}  // namespace
}  // namespace octetra::distributed
