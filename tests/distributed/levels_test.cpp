#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/index_map.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/reference_steps.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/tagged_meshes.hpp"
#include "support/thrown.hpp"

/// AdaptiveMesh::levels() and the transfer of values between levels.
namespace octetra::distributed {
namespace {

using testing::HasSubstr;

/// An entity by the global numbers of its vertices, with its marker.
template <std::size_t N>
struct Entity {
    std::array<std::uint64_t, N> vertices;
    Marker marker;

    friend auto operator<=>(const Entity&, const Entity&) = default;
};

/// Collective. Returns the entities of all processes in ascending order.
template <std::size_t N>
std::vector<Entity<N>> of_all_processes(const auto& list, const auto& markers,
                                        std::span<const GlobalVertex> numbers) {
    std::vector<Entity<N>> own;
    for (std::size_t i = 0; i < list.size(); ++i) {
        own.push_back({{}, markers.empty() ? 0 : markers.data()[i]});
        for (std::size_t k = 0; k < N; ++k) {
            own.back().vertices[k] = static_cast<std::uint64_t>(numbers[list.data()[i][k].value()]);
        }
    }
    std::vector<Entity<N>> all;
    for (const auto& of_one : test::of_all(own)) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    std::ranges::sort(all);
    return all;
}

/// A level of the whole mesh, on each process.
struct WholeLevel {
    std::map<std::uint64_t, Point> points;
    std::vector<Entity<4>> cells;
    std::vector<Entity<3>> facets;
    std::vector<Entity<2>> edges;

    friend bool operator==(const WholeLevel&, const WholeLevel&) = default;
};

/// Collective.
WholeLevel whole(const Levels& levels, std::size_t k) {
    const LevelLists lists = levels.lists(k);
    const auto numbers = levels.vertex_numbers(k);
    struct Vertex {
        std::uint64_t number;
        Point point;
    };
    std::vector<Vertex> vertices;
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        vertices.push_back({static_cast<std::uint64_t>(numbers[v]), levels.points(k)[v]});
    }
    WholeLevel result;
    for (const auto& of_one : test::of_all(vertices)) {
        for (const Vertex& vertex : of_one) result.points[vertex.number] = vertex.point;
    }
    result.cells = of_all_processes<4>(lists.cells, lists.regions, numbers);
    result.facets = of_all_processes<3>(lists.facets, lists.facet_markers, numbers);
    result.edges = of_all_processes<2>(lists.edges, lists.edge_markers, numbers);
    return result;
}

/// Collective. The first process passes the mesh.
WholeLevel whole(const Mesh& mesh) {
    std::vector<GlobalVertex> numbers;
    WholeLevel result;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        numbers.push_back(GlobalVertex{v});
        result.points[v] = mesh.points[VertexIndex{v}];
    }
    result.cells = of_all_processes<4>(mesh.cells, mesh.regions, numbers);
    result.facets = of_all_processes<3>(mesh.facets, mesh.facet_markers, numbers);
    result.edges = of_all_processes<2>(mesh.edges, mesh.edge_markers, numbers);
    return result;
}

/// A mesh and the reference after the same random steps of refinement, coarsening and migration.
class LevelsOf : public testing::TestWithParam<std::tuple<std::uint64_t, Closure>> {
protected:
    LevelsOf() {
        for (int k = 0; k < 6; ++k) step(k);
    }

    void step(int k) {
        const std::uint64_t cells = test::world().sum(mesh.cells().size());
        const bool refines = k < 3 || random() % 3 != 0;
        const double share = cells > 600 ? 0.005 : (random() % 2 == 0 ? 0.03 : 0.2);
        const Selection selection{.random = RandomShare{refines ? share : 0.9, random()}};
        if (refines) {
            (void)mesh.refine(selection, {.closure = closure});
        } else {
            (void)mesh.coarsen(selection);
        }
        performed.emplace_back(refines, selection);
        std::vector<int> ranks;
        for (const std::uint64_t root : mesh.roots()) {
            ranks.push_back(static_cast<int>((root * 7 + seed + static_cast<std::uint64_t>(k)) %
                                             static_cast<std::uint64_t>(test::world().size())));
        }
        if (random() % 3 == 0) (void)mesh.migrate(ranks);
    }

    const std::uint64_t seed = std::get<0>(GetParam());
    const Closure closure = std::get<1>(GetParam());
    std::mt19937_64 random{seed};
    const Mesh input = test::tagged(test::perturbed_kuhn(2, 0.2, seed));
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), input,
        partition_cells(input, test::world().size(), parse_partition("random:3")));
    std::vector<std::pair<bool, Selection>> performed;  ///< whether it refined, and which cells
};

/// Returns the meshes of the reference's history after the same steps, on the first process.
std::vector<reference::Refinement> reference_meshes(
    const Mesh& input, const std::vector<std::pair<bool, Selection>>& performed, Closure closure) {
    test::ReferenceSteps reference{input};
    for (const auto& [refines, selection] : performed) {
        if (!refines) {
            reference.coarsen(selection, closure);
        } else if (closure == Closure::regular) {
            reference.refine_regularly(selection);
        } else {
            reference.refine(selection);
        }
    }
    if (!test::world().is_first()) return {};
    return reference::replay(reference.history());
}

TEST_P(LevelsOf, RandomStepsAreTheMeshesOfTheReferencesHistory) {
    const Levels levels = mesh.levels({.growth = 1});
    const auto expected = reference_meshes(input, performed, closure);
    EXPECT_EQ(levels.count(), test::world().max(std::uint64_t{expected.size()}));
    for (std::size_t k = 0; k < levels.count(); ++k) {
        EXPECT_EQ(levels.step(k), k);
        const Mesh empty;
        const Mesh& of_reference = expected.empty() ? empty : expected.at(k).mesh;
        const WholeLevel found = whole(levels, k);
        const WholeLevel wanted = whole(of_reference);
        EXPECT_TRUE(found.cells == wanted.cells) << "level " << k;
        EXPECT_TRUE(found.facets == wanted.facets) << "level " << k;
        EXPECT_TRUE(found.edges == wanted.edges) << "level " << k;
        EXPECT_EQ(found.points.size(), levels.vertex_count(k));
        EXPECT_TRUE(!test::world().is_first() || found.points == wanted.points) << "level " << k;
    }
}

TEST_P(LevelsOf, AMeshEndWithItsOwnListsInTheirOrder) {
    const Levels levels = mesh.levels();
    const LevelLists lists = levels.lists(levels.count() - 1);
    EXPECT_TRUE(std::ranges::equal(lists.cells, mesh.cells()));
    EXPECT_TRUE(lists.regions == mesh.regions());
    EXPECT_TRUE(std::ranges::equal(lists.facets, mesh.facets()));
    EXPECT_TRUE(lists.facet_markers == mesh.facet_markers());
    EXPECT_TRUE(std::ranges::equal(lists.edges, mesh.edges()));
    EXPECT_TRUE(lists.edge_markers == mesh.edge_markers());
}

TEST_P(LevelsOf, AMeshGrowByTheFactorFromTheSecondOneOn) {
    for (const double growth : {1.0, 1.3, 1.7, 4.0, 1e300}) {
        const Levels levels = mesh.levels({.growth = growth});
        EXPECT_EQ(levels.step(0), 0U);
        EXPECT_EQ(levels.vertex_count(levels.count() - 1), mesh.vertex_count());
        for (std::size_t k = 2; k < levels.count(); ++k) {
            EXPECT_GE(static_cast<double>(levels.vertex_count(k)),
                      growth * static_cast<double>(levels.vertex_count(k - 1)));
        }
        EXPECT_LE(levels.count(), growth > 1e9 ? 2U : 8U);
    }
}

TEST_P(LevelsOf, AMeshStayWhenItGoesOn) {
    const Levels levels = mesh.levels();
    const WholeLevel before = whole(levels, 1);
    for (int k = 6; k < 8; ++k) step(k);
    EXPECT_TRUE(whole(levels, 1) == before);
}

TEST_P(LevelsOf, ALoadedCheckpointAreThoseOfTheSavedMesh) {
    const test::SharedFolder folder;
    mesh.save(folder / "state.octetra");
    const AdaptiveMesh loaded = AdaptiveMesh::load(test::world(), folder / "state.octetra");
    const Levels levels = mesh.levels();
    const Levels again = loaded.levels();
    ASSERT_EQ(again.count(), levels.count());
    for (std::size_t k = 0; k < levels.count(); ++k) {
        EXPECT_TRUE(whole(again, k) == whole(levels, k)) << "level " << k;
    }
}

/// Each vertex has the sharers and the owner that it has in the finest mesh.
TEST_P(LevelsOf, AMeshShareVerticesAsItDoes) {
    const Levels levels = mesh.levels({.growth = 1});
    const Sharing<VertexIndex>& finest = mesh.vertex_sharing();
    EXPECT_TRUE(levels.vertex_sharing(levels.count() - 1) == finest);
    for (std::size_t k = 0; k < levels.count(); ++k) {
        const Sharing<VertexIndex>& sharing = levels.vertex_sharing(k);
        for (VertexIndex v{0}; v < VertexIndex{levels.points(k).size()}; ++v) {
            ASSERT_TRUE(std::ranges::equal(sharing.sharers(v), finest.sharers(v)));
            ASSERT_EQ(sharing.owner(v), finest.owner(v));
        }
    }
}

double corner_volume(std::span<const Point> points, const CellVertices& cell) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cell[k].value()];
    return volume(corners);
}

TEST_P(LevelsOf, AMeshHaveParentsThatConsistOfTheirChildren) {
    const Levels levels = mesh.levels({.growth = 1.5});
    for (std::size_t k = 1; k < levels.count(); ++k) {
        const LevelParents parents = levels.parents(k);
        const LevelLists fine = levels.lists(k);
        const LevelLists coarse = levels.lists(k - 1);
        ASSERT_EQ(parents.parents.size(), fine.cells.size());
        ASSERT_TRUE(coarse.cells.size() < fine.cells.size() || fine.cells.empty());
        std::vector<double> shares(coarse.cells.size(), 0);
        for (std::size_t i = 0; i < fine.cells.size(); ++i) {
            const CellIndex parent = parents.parents[i];
            const double share = std::ldexp(1.0, -parents.halvings[i]);
            shares[parent.value()] += share;
            EXPECT_NEAR(corner_volume(levels.points(k), fine.cells[CellIndex{i}]),
                        share * corner_volume(levels.points(k - 1), coarse.cells[parent]), 1e-14);
        }
        for (const double sum : shares) EXPECT_EQ(sum, 1);
    }
}

/// Multiplies the rows of this process by values on a level, and returns the product for all its
/// vertices on the next level.
std::vector<double> product(const Levels& levels, std::size_t k,
                            const std::vector<double>& values) {
    const auto map = [&](std::size_t level) {
        return make_index_map(test::world(), levels.vertex_sharing(level),
                              levels.points(level).size());
    };
    const IndexMap<VertexIndex> coarse = map(k);
    const IndexMap<VertexIndex> fine = map(k + 1);
    std::map<std::uint64_t, double> value_of;
    for (std::size_t v = 0; v < values.size(); ++v) value_of[coarse.numbers[v]] = values[v];
    const SparseRows rows = levels.prolongation(k);
    EXPECT_EQ(rows.row_begin.size(), fine.owned_count + 1);
    std::vector<double> result(fine.numbers.size(), 0);
    for (std::size_t row = 0; row < fine.owned_count; ++row) {
        double sum = 0;
        for (std::size_t i = rows.row_begin[row]; i < rows.row_begin[row + 1]; ++i) {
            EXPECT_TRUE(i == rows.row_begin[row] || rows.columns[i - 1] < rows.columns[i]);
            result[fine.entities[row].value()] += rows.values[i] * value_of.at(rows.columns[i]);
            sum += rows.values[i];
        }
        EXPECT_EQ(sum, 1);
    }
    update_copies(test::world(), levels.vertex_sharing(k + 1), result.size(), result);
    return result;
}

TEST_P(LevelsOf, AMeshInterpolateLinearFunctionsToRounding) {
    const Levels levels = mesh.levels();
    for (std::size_t k = 0; k + 1 < levels.count(); ++k) {
        std::vector<double> coordinates;
        std::vector<double> x;
        for (const Point& p : levels.points(k)) {
            coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
            x.push_back(p.x);
        }
        const auto fine = levels.points(k + 1);
        const std::vector<double> prolonged = levels.prolong(k, coordinates, 3);
        const std::vector<double> by_rows = product(levels, k, x);
        ASSERT_EQ(prolonged.size(), 3 * fine.size());
        ASSERT_EQ(by_rows.size(), fine.size());
        for (std::size_t v = 0; v < fine.size(); ++v) {
            EXPECT_EQ((Point{prolonged[3 * v], prolonged[3 * v + 1], prolonged[3 * v + 2]}),
                      fine[v]);
            EXPECT_NEAR(by_rows[v], fine[v].x, 1e-15);
        }
    }
}

/// Collective. The sum over the vertices of the whole level, each counted at its owner.
double inner_product(const Levels& levels, std::size_t k, const std::vector<double>& a,
                     const std::vector<double>& b) {
    std::vector<double> own(1, 0);
    for (std::size_t v = 0; v < a.size(); ++v) {
        if (levels.vertex_sharing(k).is_owned(VertexIndex{v})) own[0] += a[v] * b[v];
    }
    double sum = 0;
    for (const auto& of_one : test::of_all(own)) sum += of_one[0];
    return sum;
}

TEST_P(LevelsOf, AMeshRestrictResidualsByTheTranspose) {
    const Levels levels = mesh.levels();
    const auto values = [&](std::size_t k, double a) {  // whole numbers: sums are exact
        std::vector<double> result;
        for (const GlobalVertex number : levels.vertex_numbers(k)) {
            result.push_back(std::floor(8 * std::sin(a * static_cast<double>(number))));
        }
        return result;
    };
    for (std::size_t k = 1; k < levels.count(); ++k) {
        const std::vector<double> u = values(k - 1, 1);
        const std::vector<double> r = values(k, 2);
        const std::vector<double> restricted = levels.restrict_residual(k, r);
        EXPECT_EQ(inner_product(levels, k - 1, restricted, u),
                  inner_product(levels, k, r, levels.prolong(k - 1, u)));
        std::vector<double> copies = restricted;
        update_copies(test::world(), levels.vertex_sharing(k - 1), copies.size(), copies);
        EXPECT_TRUE(copies == restricted);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LevelsOf,
                         testing::Combine(testing::Range<std::uint64_t>(0, 4),
                                          testing::Values(Closure::longest_edge,
                                                          Closure::regular)));

AdaptiveMesh fine_cube() {
    const Mesh input = test::kuhn(2, 2, 2);
    AdaptiveMesh mesh = AdaptiveMesh::distribute(test::world(), input,
                                                 partition_cells(input, test::world().size(), {}));
    (void)mesh.refine(Selection{.all = true});
    return mesh;
}

TEST(Levels, OfAMeshWithoutRefinementAreTheInputAlone) {
    const Mesh input = test::kuhn(1, 1, 1);
    const AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), input, partition_cells(input, test::world().size(), {}));
    const Levels levels = mesh.levels();
    EXPECT_EQ(levels.count(), 1U);
    EXPECT_EQ(levels.vertex_count(0), 8U);
    EXPECT_THROW((void)levels.prolongation(0), InputError);
}

TEST(Levels, RefuseInvalidArgumentsOnAllProcesses) {
    const AdaptiveMesh mesh = fine_cube();
    for (const double growth : {0.99, -1.0, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)mesh.levels({.growth = growth}); }),
                    HasSubstr("levels: growth is a finite number from 1 on, not"));
    }
    const Levels levels = mesh.levels();
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)levels.points(2); }),
                HasSubstr("the levels of the mesh are 0 to 1"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)levels.prolongation(1); }),
                HasSubstr("no next level"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)levels.parents(0); }),
                HasSubstr("no parents"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)levels.restrict_residual(0, {}); }),
                HasSubstr("no previous level"));
    EXPECT_THAT(test::thrown_by<InputError>(
                    [&] { (void)levels.restrict_residual(1, std::vector<double>(1)); }),
                HasSubstr("were expected"));
    if (test::world().size() == 1) return;
    const bool is_first = test::world().is_first();
    EXPECT_THAT(
        test::thrown_by<InputError>([&] { (void)mesh.levels({.growth = is_first ? 2.0 : 3.0}); }),
        HasSubstr("growth"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)levels.prolongation(is_first ? 0 : 1); }),
                HasSubstr("level"));
}

}  // namespace
}  // namespace octetra::distributed
