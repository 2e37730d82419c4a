#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/predicted_cells.hpp>
#include <octetra/distributed/refine.hpp>

#include "partition/cell_graph.hpp"
#include "support/meshes.hpp"

/// Tests of the predicted number of cells that each cell becomes, and of partitions by this weight.
namespace octetra::distributed {
namespace {

using testing::Each;
using testing::IsEmpty;

constexpr std::array<std::pair<Scheme, int>, 3> schemes{
    {{Scheme::eight, 8}, {Scheme::four, 4}, {Scheme::two, 2}}};

/// The number of cells that each cell of the mesh becomes.
std::vector<float> real_cells(const Mesh& mesh, const Selection& selection, int levels) {
    DistributedMesh refined = distribute(Communicator(), mesh, {});
    refine(refined, selection, {.levels = levels});
    const Collected collected = collect(std::move(refined));
    std::vector<float> cells(mesh.cells.size(), 0);
    for (const CellIndex parent : collected.maps.cell_to_parent) ++cells[parent.value()];
    return cells;
}

double sum_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

Selection ball(const Point& centre, double radius) {
    return {.spheres = {{.centre = centre, .radius = radius}}};
}

TEST(PredictedCells, AreAbsentIfTheSelectionMarksAllOrNone) {
    const Mesh mesh = test::kuhn(3, 3, 3);
    const auto predicted = [&](const Selection& selection, int levels) {
        return predicted_cells(mesh, selection, Scheme::eight, levels);
    };
    EXPECT_THAT(predicted({.all = true}, 3), IsEmpty());
    EXPECT_THAT(predicted(ball({1, 1, 1}, 1), 0), IsEmpty());
    EXPECT_THAT(predicted(ball({9, 9, 9}, 1), 3), IsEmpty()) << "it marks nothing";
    EXPECT_THAT(predicted({.boxes = {{{0, 0, 0}, {3, 3, 3}}}}, 3), IsEmpty()) << "it marks all";
    EXPECT_THAT(predicted({.random = RandomShare{0.3, 1}}, 3), IsEmpty());
    EXPECT_THAT(predicted_cells(Mesh{}, ball({0, 0, 0}, 1), Scheme::eight, 3), IsEmpty());
}

TEST(PredictedCells, OfTagsAndNumbersAreAsManyAsTheSchemeMakes) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        mesh.regions.append(c % 3 == 0 ? -7 : 0);
    }
    Selection selection;
    selection.cells.push_back(GlobalCell{4});
    selection.regions.push_back(-7);
    for (const auto& [scheme, of_one] : schemes) {
        const auto predicted = predicted_cells(mesh, selection, scheme, 3);
        ASSERT_EQ(predicted.size(), mesh.cells.size());
        for (std::size_t c = 0; c < predicted.size(); ++c) {
            const bool is_marked = c == 4 || c % 3 == 0;
            EXPECT_EQ(predicted[c], is_marked ? of_one * of_one * of_one : 1) << c;
        }
    }
}

TEST(PredictedCells, OfALargestVolumeAreAsManyAsMakeThemSmall) {
    Mesh mesh = test::kuhn(2, 1, 1);
    for (Point& p : mesh.points)
        p.x = p.x == 2 ? 9 : p.x;  // the second cube is eight times as long
    for (const auto& [scheme, of_one] : schemes) {
        const auto predicted = predicted_cells(mesh, {.max_volume = 0.17}, scheme, 4);
        ASSERT_EQ(predicted.size(), 12U);
        EXPECT_THAT(std::vector(predicted.begin(), predicted.begin() + 6), Each(1));
        EXPECT_THAT(std::vector(predicted.begin() + 6, predicted.end()),
                    Each(scheme == Scheme::four ? 16 : 8));
        const auto once = predicted_cells(mesh, {.max_volume = 0.17}, scheme, 1);
        EXPECT_EQ(once.back(), of_one) << "as there is but one level";
    }
}

TEST(PredictedCells, OfABoxCountTheCellsInside) {
    const Mesh mesh = test::kuhn(4, 4, 4);
    const auto predicted =
        predicted_cells(mesh, {.boxes = {{{0, 0, 0}, {1.5, 4, 4}}}}, Scheme::eight, 4);
    // The first of the four layers of cubes is inside, half of the second, and nothing of the
    // others.
    std::array<double, 4> of_layer{};
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        double x = 0;
        for (const VertexIndex v : mesh.cells[c]) x += mesh.points[v].x / 4;
        of_layer.at(static_cast<std::size_t>(x)) += predicted[c.value()];
    }
    constexpr double whole = 16 * 6 * 4096;
    EXPECT_EQ(of_layer[0], whole);
    EXPECT_NEAR(of_layer[1], whole / 2, whole / 20);
    EXPECT_EQ(of_layer[2], 16 * 6);
    EXPECT_EQ(of_layer[3], 16 * 6);
}

TEST(PredictedCells, OfASphereAreCloseToTheResultOfRefinement) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const Mesh mesh = test::perturbed_kuhn(8, 0.2, seed);
        for (const double radius : {0.9, 1.7, 3.0}) {
            const Selection selection = ball({2, 2, 3}, radius);
            const auto predicted = predicted_cells(mesh, selection, Scheme::eight, 3);
            const auto real = real_cells(mesh, selection, 3);
            ASSERT_EQ(predicted.size(), real.size());
            double difference = 0;
            for (std::size_t c = 0; c < real.size(); ++c) {
                difference += std::abs(predicted[c] - real[c]);
            }
            EXPECT_LT(difference, 0.5 * sum_of(real)) << radius;
            EXPECT_GT(sum_of(predicted), 0.5 * sum_of(real)) << radius;
            EXPECT_LT(sum_of(predicted), 1.1 * sum_of(real)) << radius;
        }
    }
}

TEST(PredictedCells, AreFiniteHoweverManyLevelsAndHoweverLargeTheMesh) {
    const Mesh mesh = test::kuhn(2, 2, 2, 8e307);  // opposite corners, so that sums overflow
    Selection selection = ball({8e307, 8e307, 8e307}, 4e307);
    selection.cells.push_back(GlobalCell{0});
    const auto once = predicted_cells(mesh, selection, Scheme::eight, 1);
    ASSERT_EQ(once.size(), 48U);
    EXPECT_THAT(once, Each(testing::AllOf(testing::Ge(1), testing::Le(8))));
    const auto often = predicted_cells(mesh, selection, Scheme::eight, 50);
    EXPECT_EQ(often.front(), 1e9F);
    EXPECT_THAT(often, Each(testing::AllOf(testing::Ge(1), testing::Le(1e9F))));

    Mesh uneven = test::kuhn(2, 1, 1);
    for (Point& p : uneven.points) p.x = p.x == 2 ? 9 : p.x;
    const auto small = predicted_cells(uneven, {.max_volume = 2e-9}, Scheme::eight, 50);
    EXPECT_EQ(small.front(), 0x1p27F) << "the first power of 8 that is 1/6 / 2e-9 or more";
    EXPECT_EQ(small.back(), 1e9F) << "and not 2^30";
}

TEST(PredictedCells, ByLotAreEquallyManyBesideThoseOfOtherCriteria) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    Selection selection{.random = RandomShare{0.5, 1}};
    selection.cells.push_back(GlobalCell{7});
    const auto predicted = predicted_cells(mesh, selection, Scheme::eight, 2);
    ASSERT_EQ(predicted.size(), 48U);
    for (std::size_t c = 0; c < 48; ++c) EXPECT_EQ(predicted[c], c == 7 ? 64 : 4.5 * 4.5);
}

TEST(Weights, MakePartsEqualInTheirSums) {
    const Mesh mesh = test::perturbed_kuhn(10, 0.2, 1);
    for (const int levels : {1, 4}) {
        const auto weights = predicted_cells(mesh, ball({2, 2, 2}, 1.8), Scheme::eight, levels);
        ASSERT_GT(std::ranges::max(weights), 1);
        for (const std::string method : {"rcb", "lepp", "dual"}) {
            for (const int parts : {2, 3, 5}) {
                const auto part = partition_cells(mesh, parts, parse_partition(method), weights);
                std::vector<double> sums(static_cast<std::size_t>(parts), 0);
                for (std::size_t c = 0; c < part.size(); ++c) {
                    sums[static_cast<std::size_t>(part[c])] += weights[c];
                }
                EXPECT_LT(std::ranges::max(sums) * parts, 1.15 * sum_of(weights))
                    << method << " in " << parts << ", " << levels << " levels";
            }
        }
    }
}

std::vector<int> cells_of_parts(const std::vector<int>& part, int parts) {
    std::vector<int> cells(static_cast<std::size_t>(parts), 0);
    for (const int p : part) ++cells[static_cast<std::size_t>(p)];
    return cells;
}

TEST(Weights, OfAnyMagnitudeCountByTheirRatios) {
    const Mesh mesh = test::perturbed_kuhn(8, 0.2, 1);
    std::vector<float> weights(mesh.cells.size());
    for (std::size_t c = 0; c < weights.size(); ++c) weights[c] = c % 3 == 0 ? 5 : 1;
    const auto expected = partition_cells(mesh, 4, parse_partition("lepp"), weights);
    EXPECT_NE(expected, partition_cells(mesh, 4, parse_partition("lepp")))
        << "or this would test nothing";
    for (const float times : {0x1p-90F, 0x1p-10F, 0x1p40F, 0x1p100F}) {
        std::vector<float> scaled = weights;
        for (float& weight : scaled) weight *= times;
        EXPECT_EQ(partition_cells(mesh, 4, parse_partition("lepp"), scaled), expected) << times;
    }
    const std::vector<float> even(mesh.cells.size(), 1e30F);
    EXPECT_THAT(cells_of_parts(partition_cells(mesh, 4, parse_partition("lepp"), even), 4),
                Each(testing::AllOf(testing::Ge(700), testing::Le(840))));
}

/// METIS alone leaves parts empty here, and prints a warning on standard output.
TEST(Weights, OfAFewCellsThatOutweighAllOthersSpreadThemAndLeaveNoPartEmpty) {
    const Mesh mesh = test::perturbed_kuhn(12, 0.2, 1);
    for (const int heavy : {1, 2, 3, 10, 30}) {
        std::vector<float> weights(mesh.cells.size(), 1);
        for (int h = 0; h < heavy; ++h) weights[static_cast<std::size_t>(5000 + h)] = 262144;
        for (const std::string method : {"lepp", "dual"}) {
            for (const int parts : {2, 4, 8, 32}) {
                testing::internal::CaptureStdout();
                const auto part = partition_cells(mesh, parts, parse_partition(method), weights);
                EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
                EXPECT_THAT(cells_of_parts(part, parts), Each(testing::Gt(0)));
                const auto of_heavy =
                    cells_of_parts({part.begin() + 5000, part.begin() + 5000 + heavy}, parts);
                EXPECT_LE(std::ranges::max(of_heavy), (heavy + parts - 1) / parts + 1)
                    << heavy << " in " << parts << " by " << method;
            }
        }
    }
}

TEST(Weights, AreRefusedUnlessThereIsAPositiveAndFiniteOneForEachCell) {
    const Mesh mesh = test::kuhn(3, 3, 3);
    const std::vector<float> good(mesh.cells.size(), 1);
    EXPECT_NO_THROW((void)partition_cells(mesh, 2, {}, good));
    EXPECT_THROW((void)partition_cells(mesh, 2, {}, {1, 1}), InputError);
    for (const float wrong : {0.0F, -1.0F, std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()}) {
        auto weights = good;
        weights[17] = wrong;
        EXPECT_THROW((void)partition_cells(mesh, 2, {}, weights), InputError) << wrong;
    }
}

TEST(Weights, AreThoseOfTheNodesAndOfNoneTooMuchButOfSingleCells) {
    const Mesh mesh = test::perturbed_kuhn(5, 0.2, 1);
    std::vector<float> of_cells(mesh.cells.size());
    for (std::size_t c = 0; c < of_cells.size(); ++c) of_cells[c] = c % 7 == 0 ? 100 : 2;
    const CellWeights weights(of_cells, 2);
    EXPECT_NEAR(weights.of(CellIndex{0}) / 50.0, weights.of(CellIndex{1}), 1);
    const std::int64_t most = 25 * weights.of(CellIndex{1});
    for (const CellGraph& graph :
         {lepp_graph(mesh, weights, most), face_dual_graph(mesh, weights)}) {
        std::map<std::int32_t, std::vector<CellIndex>> nodes;
        for (std::size_t c = 0; c < of_cells.size(); ++c) {
            nodes[graph.cell_to_node[c]].push_back(CellIndex{c});
        }
        for (const auto& [node, cells] : nodes) {
            const std::int64_t sum = weights.of_all(cells);
            EXPECT_EQ(graph.node_weights[static_cast<std::size_t>(node)], sum);
            EXPECT_TRUE(cells.size() == 1 || sum <= most) << sum;
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
