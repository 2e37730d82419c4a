#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "distributed/gmsh_text.hpp"
#include "distributed/marked_mesh.hpp"
#include "distributed/mesh_texts.hpp"
#include "distributed/outcomes.hpp"
#include "distributed/world.hpp"

/// Tests of collective reading of Gmsh files.
namespace octetra {
namespace {

using test::are_read_together;
using test::expect_one_outcome;
using test::Files;
using test::files_of;
using test::GmshForm;
using test::replaced;

const std::vector<MshFormat> all_kinds{{.is_2 = false, .is_text = false},
                                       {.is_2 = false, .is_text = true},
                                       {.is_2 = true, .is_text = false},
                                       {.is_2 = true, .is_text = true}};

std::string shown(const MshFormat& format) {
    return fmt::format("version {}, {}", format.is_2 ? 2 : 4, format.is_text ? "text" : "binary");
}

/// One process reads a file of any form.
bool is_alone() { return test::world().size() == 1; }

Files msh(const std::string& text) { return {".msh", {{".msh", text}}}; }
Files msh(const Mesh& mesh, const GmshForm& form) { return msh(test::GmshText(mesh, form).text()); }

/// Tags are signed 32-bit numbers in version 2.
std::uint64_t scattered(std::uint64_t v) { return 1 + v * 7919 % 10007 * 1000; }

TEST(ReadGmshTogether, MeshesWithEverythingEqualThoseOfSerialReading) {
    for (const MshFormat& format : all_kinds) {
        SCOPED_TRACE(shown(format));
        for (const std::size_t n : {1U, 2U, 6U}) {
            const Files files = files_of(test::full_mesh(n, 1), ".msh", {.msh = format});
            EXPECT_TRUE(are_read_together(files)) << n;
            EXPECT_TRUE(expect_one_outcome(files)) << n;
        }
    }
}

TEST(ReadGmshTogether, TagsOfAnyOrderBecomeTheNumbersOfSerialReading) {
    const std::uint64_t count = 27;
    const std::vector<std::function<std::uint64_t(std::uint64_t)>> orders{
        [](std::uint64_t v) { return v + 1000; },
        [](std::uint64_t v) { return 3 * v; },
        [&](std::uint64_t v) { return count - v; },
        [&](std::uint64_t v) { return 5 + 10 * v % count; },
        scattered,
        [&](std::uint64_t v) { return v < count / 2 ? v : v + 1'000'000'000; }};
    const Mesh mesh = test::full_mesh(2, 1);
    ASSERT_EQ(mesh.points.size(), count);
    for (const MshFormat& format : all_kinds) {
        SCOPED_TRACE(shown(format));
        for (std::size_t k = 0; k < orders.size(); ++k) {
            const Files files = msh(mesh, {.format = format, .tag_of = orders[k]});
            EXPECT_TRUE(are_read_together(files)) << k;
            EXPECT_TRUE(expect_one_outcome(files)) << k;
        }
    }
}

TEST(ReadGmshTogether, TagsOf64BitsAreReadTogetherUnlessTheyAreFarApart) {
    const Mesh mesh = test::full_mesh(2, 1);
    for (const bool is_text : {true, false}) {
        const auto with = [&](const auto& tag_of) {
            return msh(mesh, {.format = {.is_text = is_text}, .tag_of = tag_of});
        };
        const Files high = with([](std::uint64_t v) { return ~(3 * v); });
        EXPECT_TRUE(are_read_together(high));
        EXPECT_TRUE(expect_one_outcome(high));
        const Files apart = with([](std::uint64_t v) { return v << 40U; });
        EXPECT_EQ(are_read_together(apart), is_alone());
        EXPECT_TRUE(expect_one_outcome(apart));
    }
}

/// A process's share may begin within a block, between blocks or after many blocks.
TEST(ReadGmshTogether, BlocksOfAnyLengthAreFound) {
    for (const MshFormat& format : all_kinds) {
        SCOPED_TRACE(shown(format));
        for (const std::size_t block : {1U, 3U, 50U, 100000U}) {
            for (const bool odd : {false, true}) {
                const Files files = msh(test::full_mesh(3, 1), {.format = format,
                                                                .tag_of = scattered,
                                                                .block = block,
                                                                .is_parametric = odd,
                                                                .has_points = odd});
                EXPECT_TRUE(are_read_together(files)) << block;
                EXPECT_TRUE(expect_one_outcome(files)) << block;
            }
        }
    }
}

/// Large enough that lines are sought in the middle of a file, and that there are many messages.
TEST(ReadGmshTogether, AMeshOfManyCellsEqualsThatOfSerialReading) {
    Mesh mesh = test::kuhn(34, 33, 32, 1.0 / 3);
    test::list_boundary(mesh);
    const auto backwards = [&](std::uint64_t v) { return mesh.points.size() - v; };
    for (const MshFormat& format : all_kinds) {
        SCOPED_TRACE(shown(format));
        const Files files = msh(mesh, {.format = format, .tag_of = backwards, .block = 100000});
        EXPECT_TRUE(are_read_together(files));
        EXPECT_TRUE(expect_one_outcome(files));
    }
}

/// Version 2 lists an element once for each of its groups, and shares may begin between these.
TEST(ReadGmshTogether, ElementsOfSeveralGroupsAreKeptOnce) {
    for (const bool is_text : {true, false}) {
        for (const std::size_t groups : {2U, 3U, 5U}) {
            const Files files = msh(test::full_mesh(3, 1),
                                    {.format = {true, is_text}, .block = 50, .groups = groups});
            EXPECT_TRUE(are_read_together(files)) << groups;
            EXPECT_TRUE(expect_one_outcome(files)) << groups;
        }
    }
}

const std::string head_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes_2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string cell_2 = "$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n";
const std::string head_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes_4 =
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string cell_4 = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

std::string elements_2(const std::vector<std::string>& rows) {
    return fmt::format("$Elements\n{}\n{}\n$EndElements\n", rows.size(), fmt::join(rows, "\n"));
}

struct OddGmsh {
    std::string name;
    std::string text;
    bool is_mesh = true;
    bool together = true;  ///< false if one process must read it alone or refuse it
};

std::vector<OddGmsh> odd_gmsh_files() {
    const std::string two = head_2 + nodes_2 + cell_2;
    const std::string four = head_4 + nodes_4 + cell_4;
    const std::string tail = four.substr(four.find("$Elements"));
    const std::string no_blocks = "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n0 0 0 0\n$EndElements\n";
    return {
        {"one cell of 2", two},
        {"one cell of 4", four},
        {"nothing of 2", head_2 + "$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n"},
        {"nothing of 4", head_4 + no_blocks},
        {"no cell", head_2 + nodes_2 + "$Elements\n0\n$EndElements\n"},
        {"line ends of Windows", replaced(four, "\n", "\r\n")},
        {"blanks and comments on lines", replaced(four, "\n", " \t # x\n ")},
        {"a byte order mark", "\xef\xbb\xbf" + four},
        {"no last line end", four.substr(0, four.size() - 1)},
        {"blank lines between sections", replaced(four, "\n$", "\n\n \n# x\n$")},
        {"blank lines between rows", replaced(four, "1 0 0\n", "1 0 0\n\n"), true, false},
        {"a row over two lines", replaced(four, "1 1 2 3 4", "1 1\n2 3 4"), true, false},
        {"two rows on a line", replaced(four, "2\n3\n4\n", "2 3\n4\n"), true, false},
        {"a count behind a section's name", replaced(two, "$Nodes\n4", "$Nodes 4")},
        {"totals over two lines", replaced(four, "1 4 1 4\n", "1 4\n1 4\n")},
        {"a block's head over two lines", replaced(four, "3 1 0 4\n", "3 1\n0 4\n")},
        {"sections that are not kept",
         replaced(two, "$Nodes", "$Comments\n$Nodes\n$EndComments\n$X\n$Y\n$EndX\n$Nodes") +
             "$X\n$EndX\n$Z\n1 2 3\n$EndZ\n"},
        {"a section without end", two + "$X\n", false, false},
        {"a second section", two + nodes_2, false, false},
        {"elements before nodes", head_2 + cell_2 + nodes_2, false, false},
        {"entities of 2", head_2 + "$Entities\n0 0 0 0\n$EndEntities\n" + nodes_2, false, false},
        {"no elements", head_2 + nodes_2, false, false},
        {"no section", "", false, false},
        {"version 4.0", replaced(four, "4.1", "4.0"), false, false},
        {"a tag twice", replaced(four, "\n3\n4\n", "\n2\n4\n"), false, false},
        {"a tag twice, far apart",
         replaced(replaced(four, "\n3\n4\n", "\n900\n4\n"), "\n2\n", "\n900\n"), false, false},
        {"a tag twice, and every node that is asked for",
         head_4 +
             "$Nodes\n1 5 1 4\n3 1 0 5\n1\n2\n3\n4\n4\n"
             "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 2\n$EndNodes\n" +
             cell_4,
         false, false},
        {"a node that there is not", replaced(four, "1 1 2 3 4", "1 1 2 3 5"), false, false},
        {"a node in a gap", replaced(replaced(four, "\n4\n", "\n9\n"), "1 1 2 3 4", "1 1 2 3 4"),
         false, false},
        {"a vertex twice", replaced(four, "1 1 2 3 4", "1 1 2 3 3"), false, false},
        {"an inverted cell", replaced(four, "1 1 2 3 4", "1 2 1 3 4"), false},
        {"an empty block", replaced(replaced(four, "1 1 1 1\n", "3 1 1 1\n1 5 99 0\n"),
                                    "\n$EndElements", "\n2 7 2 0\n$EndElements")},
        {"fewer blocks", replaced(four, "$Elements\n1 1", "$Elements\n0 1"), false, false},
        {"more blocks", replaced(four, "$Elements\n1 1", "$Elements\n2 1"), false, false},
        {"fewer elements", replaced(four, "$Elements\n1 1", "$Elements\n1 2"), false, false},
        {"more nodes", replaced(four, "$Nodes\n1 4", "$Nodes\n1 3"), false, false},
        {"a huge block", replaced(four, "3 1 4 1", "3 1 4 4000000000"), false, false},
        {"elements of an unknown type", replaced(four, "3 1 4 1", "3 1 999 1"), false, false},
        {"second order", replaced(four, "3 1 4 1", "3 1 11 1"), false, false},
        {"triangles alone", head_2 + nodes_2 + elements_2({"1 2 2 7 1 1 2 3"}), false, false},
        {"a triangle of no cell",
         head_2 + replaced(nodes_2, "4\n1", "5\n9 9 9 9\n1") +
             elements_2({"1 4 2 7 1 1 2 3 4", "2 2 2 7 1 1 2 9"}),
         false},
        {"an element listed twice in one group",
         head_2 + nodes_2 + elements_2({"1 4 2 7 1 1 2 3 4", "2 4 2 7 1 1 2 3 4"}), false},
        {"an element listed again, turned round",
         head_2 + nodes_2 + elements_2({"1 4 2 7 1 1 2 3 4", "2 4 2 8 1 2 1 3 4"})},
        {"listed in groups in turn",
         head_2 + nodes_2 +
             elements_2({"1 4 2 7 1 1 2 3 4", "2 2 2 4 2 1 2 3", "3 2 2 5 2 1 2 3",
                         "4 2 2 4 2 1 2 3", "5 2 2 5 2 1 2 3"}),
         true, true},
        {"of two entities",
         head_2 + nodes_2 + elements_2({"1 4 2 7 1 1 2 3 4", "2 4 2 8 2 1 2 3 4"}), false},
        {"an element of node 0",
         head_2 + nodes_2 + elements_2({"1 4 2 7 1 1 2 3 4", "2 2 2 7 0 0 0 0"}), false, false},
        {"no tags", head_2 + nodes_2 + elements_2({"1 4 0 1 2 3 4"})},
        {"a bad number", replaced(four, "0 1 0\n", "0 1 x\n"), false, false},
        {"one field too many",
         replaced(tail, "1 1 2 3 4", "1 1 2 3 4 5").insert(0, head_4 + nodes_4), false, false},
    };
}

TEST(ReadGmshTogether, OddFilesHaveTheOutcomeOfSerialReading) {
    for (const OddGmsh& one : odd_gmsh_files()) {
        SCOPED_TRACE(one.name);
        const bool together = are_read_together(msh(one.text));
        if (is_alone()) {
            EXPECT_TRUE(together || !one.is_mesh);
        } else if (one.name != "listed in groups in turn") {  // where shares begin decides
            EXPECT_EQ(together, one.together);
        }
        EXPECT_EQ(expect_one_outcome(msh(one.text)), one.is_mesh);
    }
}

/// A blank line, and later two rows on one line, within the share of one process: the total number
/// of lines is right, but the rows between are not at their expected lines.
TEST(ReadGmshTogether, RowsThatMakeUpForABlankLineAreReadByOneProcess) {
    std::string text = test::GmshText(test::full_mesh(2, 1), {.format = {true, true}}).text();
    text = replaced(replaced(text, "\n2 ", "\n\n2 "), "\n4 ", " 4 ");
    EXPECT_EQ(are_read_together(msh(text)), is_alone());
    EXPECT_TRUE(expect_one_outcome(msh(text)));
}

TEST(ReadGmshTogether, FilesChangedAtRandomHaveTheOutcomeOfSerialReading) {
    const char* const given = std::getenv("OCTETRA_READING_SEED");
    std::vector<std::uint64_t> seed{given != nullptr ? std::strtoull(given, nullptr, 10)
                                                     : std::random_device()()};
    test::world().broadcast(seed);
    SCOPED_TRACE(fmt::format("OCTETRA_READING_SEED={}", seed.front()));
    std::mt19937_64 random(seed.front());
    const Mesh mesh = test::full_mesh(1, 1);
    std::vector<std::string> texts;
    for (const MshFormat& format : all_kinds) {
        texts.push_back(files_of(mesh, ".msh", {.msh = format}).text(".msh"));
        texts.push_back(test::GmshText(mesh, {.format = format,
                                              .tag_of = scattered,
                                              .block = 3,
                                              .is_parametric = true,
                                              .groups = 2,
                                              .has_points = true})
                            .text());
    }
    int meshes = 0;
    // With more processes than cores each turn is slow.
    const int turns = OCTETRA_SANITIZED ? 100 : test::world().size() > 3 ? 200 : 1000;
    for (int turn = 0; turn < turns; ++turn) {
        const std::string text = test::mutated(texts[random() % texts.size()], random);
        if (expect_one_outcome(msh(text))) ++meshes;
        if (testing::Test::HasFailure()) {
            FAIL() << "turn " << turn << " of OCTETRA_READING_SEED=" << seed.front() << "\n"
                   << text;
        }
    }
    EXPECT_GT(meshes, 0);
    EXPECT_LT(meshes, turns);
}

}  // namespace
}  // namespace octetra
