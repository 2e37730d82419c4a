#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>

#include "partition/cell_graph.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra::distributed {
namespace {

using testing::HasSubstr;

TEST(Partition, OfEveryMethodAssignsAPartToEachCell) {
    const Mesh mesh = test::perturbed_kuhn(4, 0.2, 1);
    for (const std::string method : {"lepp", "dual", "block", "random:3"}) {
        for (const int parts : {1, 2, 5, 400}) {
            const auto part = partition_cells(mesh, parts, parse_partition(method));
            ASSERT_EQ(part.size(), mesh.cells.size()) << method;
            EXPECT_GE(std::ranges::min(part), 0);
            EXPECT_LT(std::ranges::max(part), parts);
            if (parts <= 5) {
                for (int p = 0; p < parts; ++p) {
                    const auto share = std::ranges::count(part, p) * parts;
                    EXPECT_GT(share, 300) << method << " leaves part " << p << " of " << parts;
                }
            }
        }
    }
    EXPECT_TRUE(partition_cells(Mesh{}, 3, parse_partition("lepp")).empty());
}

extern "C" void ignore_signal(int /*signal*/) {}

/// METIS installs its own handlers while it works.
TEST(Partition, LeavesSignalHandlersAsTheyWere) {
    struct sigaction mine {};
    mine.sa_handler = ignore_signal;
    mine.sa_flags = SA_RESTART;
    struct sigaction before {};
    ASSERT_EQ(::sigaction(SIGTERM, &mine, &before), 0);
    (void)partition_cells(test::perturbed_kuhn(4, 0.2, 1), 5, parse_partition("lepp"));
    struct sigaction after {};
    EXPECT_EQ(::sigaction(SIGTERM, &before, &after), 0);
    EXPECT_EQ(after.sa_handler, ignore_signal);
    EXPECT_TRUE((after.sa_flags & SA_RESTART) != 0);
    EXPECT_FALSE((after.sa_flags & static_cast<int>(SA_RESETHAND)) != 0) << "it works only once";
}

TEST(Partition, FilesAreReadAndChecked) {
    const test::TemporaryFolder folder;
    const Mesh mesh = test::kuhn(1, 1, 1);
    const auto read = [&](const std::string& text) {
        const auto path = folder.write("parts", text);
        return partition_cells(mesh, 3, parse_partition("file:" + path.string()));
    };
    EXPECT_THAT(read("# six cells\r\n\r\n0\n2\n1\n1\n0\r\n2\n"),
                testing::ElementsAre(0, 2, 1, 1, 0, 2));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\n3\n"); }),
                HasSubstr("parts:2: a part number from 0 to 2"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\nx\n"); }), HasSubstr("parts:2: "));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\n0\n"); }),
                HasSubstr("2 part numbers found for a mesh of 6 cells"));
    for (const std::string wrong : {"0\r1", "0 1", "-0", "+0", " 0"}) {
        EXPECT_THROW((void)read(wrong + "\n0\n0\n0\n0\n0\n"), InputError) << wrong;
    }
    EXPECT_THROW((void)partition_cells(mesh, 3, parse_partition("file:none")), InputError);
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const auto& no_file : {folder.path(), pipe}) {
        EXPECT_THAT(test::thrown_by<InputError>([&] {
                        (void)partition_cells(mesh, 3, parse_partition("file:" + no_file.string()));
                    }),
                    HasSubstr("is not a file"));
    }
}

TEST(Partition, NamesAreChecked) {
    for (const std::string wrong : {"", "metis", "random", "random:", "random:x", "file:"}) {
        EXPECT_THROW((void)parse_partition(wrong), InputError) << wrong;
    }
}

TEST(PartitionStatistics, CountCutsOfACubeOfSixCellsByHand) {
    const Mesh mesh = test::kuhn(1, 1, 1);  // a ring of six cells, all with the same longest edge
    const auto part = partition_cells(mesh, 1, parse_partition("block"));
    const PartitionStatistics whole = measure_partition(mesh, part, 1);
    EXPECT_EQ(whole.inner_faces, 6U);
    EXPECT_EQ(whole.cut_faces, 0U);
    EXPECT_EQ(whole.longest_edge_links, 15U);
    EXPECT_THAT(whole.shared_vertices_of_part, testing::ElementsAre(0));

    const PartitionStatistics one_cell = measure_partition(mesh, {1, 0, 0, 0, 0, 0}, 3);
    EXPECT_THAT(one_cell.cells_of_part, testing::ElementsAre(5, 1, 0));
    EXPECT_EQ(one_cell.cut_faces, 2U);
    EXPECT_EQ(one_cell.cut_longest_edge_links, 5U);
    EXPECT_THAT(one_cell.shared_vertices_of_part, testing::ElementsAre(4, 4, 0));
    EXPECT_THAT(one_cell.neighbours_of_part, testing::ElementsAre(1, 1, 0));
}

TEST(Partition, OfTheLeppGraphCutsFewerPropagationStepsThanBlocksOrLots) {
    const Mesh mesh = test::perturbed_kuhn(8, 0.2, 1);
    const auto cut = [&](const std::string& method) {
        const auto part = partition_cells(mesh, 4, parse_partition(method));
        return measure_partition(mesh, part, 4).cut_longest_edge_links;
    };
    EXPECT_LT(cut("lepp"), cut("block"));
    EXPECT_LT(cut("lepp"), cut("random:1") / 4);
}

/// Brute force over all pairs of cells.
std::size_t common_corners(const CellVertices& a, const CellVertices& b) {
    return static_cast<std::size_t>(
        std::ranges::count_if(a, [&](VertexIndex v) { return std::ranges::count(b, v) != 0; }));
}

EdgeVertices longest_edge(const Mesh& mesh, const CellVertices& cell) {
    EdgeVertices longest{cell[0], cell[1]};
    for (const auto& [i, j] : cell_edges) {
        if (longer({mesh.points[cell[i]], mesh.points[cell[j]]},
                   {mesh.points[longest[0]], mesh.points[longest[1]]})) {
            longest = {cell[i], cell[j]};
        }
    }
    return {std::min(longest[0], longest[1]), std::max(longest[0], longest[1])};
}

bool has(const CellVertices& cell, const EdgeVertices& edge) {
    return std::ranges::count(cell, edge[0]) + std::ranges::count(cell, edge[1]) == 2;
}

void for_each_pair(const Mesh& mesh, auto&& visit) {
    for (CellIndex a{0}; a < mesh.cells.end_index(); ++a) {
        for (CellIndex b{0}; b < a; ++b) visit(a, b);
    }
}

/// Cells round an edge, which is the longest edge of each.
Mesh wheel(std::size_t count) {
    std::vector<Point> points{{0, 0, -10}, {0, 0, 10}};
    std::vector<std::array<std::size_t, 4>> cells;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        points.push_back({std::cos(angle), std::sin(angle), 0});
        cells.push_back({0, 1, 2 + i, 2 + (i + 1) % count});
    }
    return test::mesh_of(points, cells);
}

/// Cells in random order, as from some mesh generators.
Mesh shuffled(Mesh mesh) {
    std::shuffle(mesh.cells.begin(), mesh.cells.end(), std::mt19937_64(1));
    return mesh;
}

TEST(PartitionStatistics, AgreeWithALookAtEveryPairOfCells) {
    for (const Mesh& mesh :
         {shuffled(test::perturbed_kuhn(4, 0.2, 1)), test::kuhn(3, 3, 3), wheel(40)}) {
        constexpr int parts = 5;
        auto part = partition_cells(mesh, parts - 1, parse_partition("random:2"));  // one is empty
        PartitionStatistics expected{.cells_of_part = std::vector<std::uint64_t>(parts),
                                     .shared_vertices_of_part = std::vector<std::uint64_t>(parts),
                                     .neighbours_of_part = std::vector<std::uint64_t>(parts)};
        std::vector<std::set<VertexIndex>> shared(parts);
        std::vector<std::set<int>> neighbours(parts);
        for (const int p : part) ++expected.cells_of_part.at(static_cast<std::size_t>(p));
        for_each_pair(mesh, [&](CellIndex a, CellIndex b) {
            const bool is_cut = part[a.value()] != part[b.value()];
            const CellVertices& u = mesh.cells[a];
            const CellVertices& v = mesh.cells[b];
            if (common_corners(u, v) == 3) {
                ++expected.inner_faces;
                if (is_cut) ++expected.cut_faces;
            }
            if (has(u, longest_edge(mesh, v)) || has(v, longest_edge(mesh, u))) {
                ++expected.longest_edge_links;
                if (is_cut) ++expected.cut_longest_edge_links;
            }
            if (!is_cut) return;
            for (const VertexIndex w : u) {
                if (std::ranges::count(v, w) == 0) continue;
                for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, a}}) {
                    const auto mine = static_cast<std::size_t>(part[p.value()]);
                    shared[mine].insert(w);
                    neighbours[mine].insert(part[q.value()]);
                }
            }
        });
        for (std::size_t p = 0; p < parts; ++p) {
            expected.shared_vertices_of_part[p] = shared[p].size();
            expected.neighbours_of_part[p] = neighbours[p].size();
        }
        const PartitionStatistics found = measure_partition(mesh, part, parts);
        EXPECT_EQ(found.cells_of_part, expected.cells_of_part);
        EXPECT_EQ(found.shared_vertices_of_part, expected.shared_vertices_of_part);
        EXPECT_EQ(found.neighbours_of_part, expected.neighbours_of_part);
        EXPECT_EQ(found.inner_faces, expected.inner_faces);
        EXPECT_EQ(found.cut_faces, expected.cut_faces);
        EXPECT_EQ(found.longest_edge_links, expected.longest_edge_links);
        EXPECT_EQ(found.cut_longest_edge_links, expected.cut_longest_edge_links);
    }
}

/// Compares the links and weights of the graph with those computed from the cells of its nodes.
void expect_links(const Mesh& mesh, const CellGraph& graph, std::int32_t face, std::int32_t path) {
    ASSERT_EQ(graph.cell_to_node.size(), mesh.cells.size());
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> expected;
    for_each_pair(mesh, [&](CellIndex a, CellIndex b) {
        const CellVertices& u = mesh.cells[a];
        const CellVertices& v = mesh.cells[b];
        const std::int32_t m = graph.cell_to_node[a.value()];
        const std::int32_t n = graph.cell_to_node[b.value()];
        if (m == n || common_corners(u, v) < 3) return;
        const std::int32_t weight = face + (has(v, longest_edge(mesh, u)) ? path : 0) +
                                    (has(u, longest_edge(mesh, v)) ? path : 0);
        expected[{m, n}] += weight;
        expected[{n, m}] += weight;
    });
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> found;
    const std::size_t nodes = graph.node_weights.size();
    ASSERT_EQ(graph.begin.size(), nodes + 1);
    for (std::size_t n = 0; n < nodes; ++n) {
        for (auto k = graph.begin[n]; k < graph.begin[n + 1]; ++k) {
            const auto link = static_cast<std::size_t>(k);
            const std::pair ends{static_cast<std::int32_t>(n), graph.neighbours.at(link)};
            EXPECT_TRUE(found.emplace(ends, graph.weights.at(link)).second) << "listed twice";
        }
        EXPECT_EQ(std::ranges::count(graph.cell_to_node, static_cast<std::int32_t>(n)),
                  graph.node_weights[n]);
    }
    EXPECT_EQ(found, expected);
}

TEST(CellGraph, OfFacesHasALinkForEveryInnerFace) {
    for (const Mesh& mesh :
         {shuffled(test::perturbed_kuhn(3, 0.2, 1)), test::kuhn(2, 3, 2), wheel(9)}) {
        const CellGraph graph = face_dual_graph(mesh, {});
        EXPECT_EQ(graph.node_weights.size(), mesh.cells.size());
        expect_links(mesh, graph, 1, 0);
    }
}

TEST(CellGraph, OfPathsWeighsFacesMoreThatHaveALongestEdge) {
    for (const Mesh& mesh :
         {shuffled(test::perturbed_kuhn(3, 0.2, 1)), test::kuhn(2, 3, 2), wheel(9)}) {
        for (const std::int64_t most : {0, 1, 3, 100}) {
            expect_links(mesh, lepp_graph(mesh, {}, most), 1, 1);
        }
    }
}

TEST(CellGraph, HasOneNodeForCellsWithTheSameLongestEdge) {
    const Mesh mesh = shuffled(test::perturbed_kuhn(4, 0.2, 1));
    constexpr std::int64_t most = 8;
    const CellGraph graph = lepp_graph(mesh, {}, most);
    std::map<EdgeVertices, std::vector<std::int32_t>> nodes;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        nodes[longest_edge(mesh, mesh.cells[c])].push_back(graph.cell_to_node[c.value()]);
    }
    for (const auto& [edge, of_its_cells] : nodes) {
        ASSERT_LE(of_its_cells.size(), most) << "or this would test nothing";
        EXPECT_EQ(std::set(of_its_cells.begin(), of_its_cells.end()).size(), 1U);
    }
    EXPECT_EQ(std::ranges::count(graph.node_weights, 1), 0) << "lone cells have neighbours here";
    EXPECT_LE(std::ranges::max(graph.node_weights), static_cast<std::int32_t>(most));
}

TEST(CellGraph, DoesNotMakeOneNodeOfAWheel) {
    EXPECT_THAT(lepp_graph(wheel(60), {}, 60).node_weights, testing::ElementsAre(60));
    const auto cells = lepp_graph(wheel(60), {}, 59).node_weights;
    EXPECT_GE(cells.size(), 10U);
    EXPECT_LE(std::ranges::max(cells), 6);
    EXPECT_THAT(lepp_graph(wheel(60), {}, 1).node_weights, testing::Each(1));
}

TEST(Partition, BalancesAWheelWhoseCellsAllHaveOneLongestEdge) {
    const Mesh mesh = shuffled(wheel(4000));
    const auto part = partition_cells(mesh, 4, parse_partition("lepp"));
    const PartitionStatistics statistics = measure_partition(mesh, part, 4);
    EXPECT_LE(std::ranges::max(statistics.cells_of_part), 1050U);
    EXPECT_LE(statistics.cut_faces, 8U) << "where four spokes would do";
}

TEST(CellGraph, TooLargeForMetisIsRefusedWithAdvice) {
    constexpr std::uint64_t most = 536'870'911;  // four links for each are just below 2^31
    EXPECT_NO_THROW(check_graph_size(most));
    for (const std::uint64_t cells : {most + 1, std::uint64_t{1} << 32U, std::uint64_t{1} << 62U}) {
        EXPECT_THAT(test::thrown_by<InputError>([&] { check_graph_size(cells); }),
                    HasSubstr("--partition block"));
    }
}

}  // namespace
}  // namespace octetra::distributed
