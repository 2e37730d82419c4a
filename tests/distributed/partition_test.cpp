#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/partition.hpp>

#include "cell_graph.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra::distributed {
namespace {

using testing::HasSubstr;

TEST(Partition, OfEveryMethodGivesEachCellAPart) {
    const Mesh mesh = test::shaken_kuhn(4, 0.2, 1);
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

TEST(Partition, FilesAreReadAndChecked) {
    const test::TemporaryFolder folder;
    const Mesh mesh = test::kuhn(1, 1, 1);
    const auto read = [&](const std::string& text) {
        const auto path = folder.write("parts", text);
        return partition_cells(mesh, 3, parse_partition("file:" + path.string()));
    };
    EXPECT_THAT(read("# six cells\n0\n2\n1\n1\n0\r\n2\n"), testing::ElementsAre(0, 2, 1, 1, 0, 2));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\n3\n"); }),
                HasSubstr("parts:2: a part number from 0 to 2"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\nx\n"); }), HasSubstr("parts:2: "));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read("0\n0\n"); }),
                HasSubstr("2 part numbers found for a mesh of 6 cells"));
    EXPECT_THROW((void)partition_cells(mesh, 3, parse_partition("file:none")), InputError);
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
    const Mesh mesh = test::shaken_kuhn(8, 0.2, 1);
    const auto cut = [&](const std::string& method) {
        const auto part = partition_cells(mesh, 4, parse_partition(method));
        return measure_partition(mesh, part, 4).cut_longest_edge_links;
    };
    EXPECT_LT(cut("lepp"), cut("block"));
    EXPECT_LT(cut("lepp"), cut("random:1") / 4);
}

TEST(CellGraph, JoinsCellsThroughFacesBothWays) {
    const Mesh mesh = test::kuhn(1, 1, 1);  // six cells round a diagonal: each has two neighbours
    const CellGraph graph = face_dual_graph(mesh);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(graph.begin[c + 1] - graph.begin[c], 2);
}

TEST(CellGraph, JoinsCellsToAllAtTheirLongestEdge) {
    const Mesh mesh = test::kuhn(1, 1, 1);  // the diagonal is everyone's longest edge
    const CellGraph graph = lepp_graph(mesh);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(graph.begin[c + 1] - graph.begin[c], 5);
}

}  // namespace
}  // namespace octetra::distributed
