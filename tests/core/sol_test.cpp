#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/sol_fields.hpp>

#include "core/meshb_files.hpp"
#include "core/refused_files.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"
#include "verify/thread_group.hpp"

/// Medit's solution files.
namespace octetra {
namespace {

using test::MeshbFile;
using test::RefusedFiles;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";

bool same(const FieldRows& a, const FieldRows& b) {
    return a.on == b.on && a.components == b.components && a.count == b.count &&
           a.values == b.values;
}

/// Checks that collective reading gives the result of serial reading, or nothing; returns whether
/// it gave a result.
bool is_read_together(const std::filesystem::path& path, const EntityCounts& counts) {
    bool together = true;
    for (const int size : {2, 3, 5}) {
        std::vector<std::optional<SolFields>> shares(static_cast<std::size_t>(size));
        test::run_together(size, [&](const ProcessGroup& group) {
            shares[static_cast<std::size_t>(group.rank())] = read_sol_share(path, counts, group);
        });
        for (const auto& share : shares) EXPECT_EQ(share.has_value(), shares[0].has_value());
        together = together && shares[0];
        if (!shares[0]) continue;
        SolFields whole = *shares[0];
        for (std::size_t r = 1; r < shares.size(); ++r) {
            for (std::size_t k = 0; k < whole.lists.size(); ++k) {
                FieldRows& list = whole.lists[k];
                const FieldRows& more = shares[r]->lists[k];
                EXPECT_EQ(more.first * list.width(), list.values.size());
                list.values.insert(list.values.end(), more.values.begin(), more.values.end());
            }
        }
        const SolFields alone = read_sol(path, counts);
        EXPECT_TRUE(std::ranges::equal(whole.lists, alone.lists, same)) << size;
        EXPECT_EQ(whole.notes, alone.notes);
    }
    return together;
}

SolFields read_text(const std::string& sections, const EntityCounts& counts) {
    const TemporaryFolder folder;
    const auto file = folder.write("v.sol", head + sections);
    (void)is_read_together(file, counts);
    return read_sol(file, counts);
}

TEST(SolReader, TakesScalarsVectorsAndTensorsOfVerticesAndCells) {
    const SolFields read = read_text(
        "SolAtVertices\n2\n3 1 2 3\n1 2 3 4 5 6 7 8 9 10\n-1 -2e0 -3 -4 -5 -6 -7 -8 -9 -0.5\n"
        "SolAtTetrahedra\n1\n1 4\n1 2 3 4 5 6 7 8 9\nEnd\n",
        {2, 1});
    ASSERT_EQ(read.lists.size(), 2U);
    EXPECT_EQ(read.lists[0].on, FieldOn::vertices);
    EXPECT_THAT(read.lists[0].components, ElementsAre(1, 3, 6));
    EXPECT_THAT(read.lists[0].values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -1, -2, -3, -4, -5,
                                                  -6, -7, -8, -9, -0.5));
    EXPECT_EQ(read.lists[1].on, FieldOn::cells);
    EXPECT_THAT(read.lists[1].values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
    EXPECT_THAT(read.notes, ElementsAre());
}

TEST(SolReader, ReadsTokensInAnyArrangementOfLines) {
    const TemporaryFolder folder;
    const auto file = folder.write("v.sol",
                                   "\xef\xbb\xbf# made by hand\r\nMeshVersionFormatted 1 "
                                   "Dimension\r\n3 SolAtVertices 2 2 1\r\n"
                                   "1 1 2 3 # of the second\r\n4 End\r\n");
    EXPECT_FALSE(is_read_together(file, {2, 0}));  // it is read serially
    EXPECT_THAT(read_sol(file, EntityCounts{2, 0}).lists.at(0).values, ElementsAre(1, 2, 3, 4));
}

TEST(SolReader, IsSharedByProcessesWhereARowIsOnALine) {
    std::string text = head + "SolAtVertices\n1000\n2 1 2\n";
    for (int i = 0; i < 1000; ++i) {
        text +=
            std::to_string(i) + " 1." + std::to_string(i) + "  2\t" + std::to_string(3 * i) + "\n";
    }
    text += "SolAtTetrahedra\n3\n1 1\n1\n2\n3\nEnd\n";
    const TemporaryFolder folder;
    EXPECT_TRUE(is_read_together(folder.write("v.sol", text), {1000, 3}));
}

TEST(SolReader, NotesTheSameLinesIfProcessesShareTheFile) {
    std::string text = head + "SolAtTriangles\n100\n1 1\n";
    for (int i = 0; i < 100; ++i) text += std::to_string(i) + "\n";
    text += "Time\n0.5\nSolAtVertices\n3\n1 1\n1\n2\n3\nIterations\n7\n";
    const TemporaryFolder folder;
    const auto file = folder.write("v.sol", text);
    EXPECT_TRUE(is_read_together(file, {3, 0}));  // compares notes
    const std::vector<std::string> notes = read_sol(file, EntityCounts{3, 0}).notes;
    ASSERT_EQ(notes.size(), 4U);
    EXPECT_THAT(notes[1], HasSubstr("v.sol:106: the 1 entries of Time are not kept"));
    EXPECT_THAT(notes[2], HasSubstr("v.sol:114: the 1 entries of Iterations are not kept"));
}

TEST(SolReader, NotesWhatIsDiscarded) {
    const SolFields read = read_text(
        "Time 0.5\nIterations 7\nSolAtTriangles 2 1 1 8 9\nSolAtVertices 1 1 1 5\n", {1, 0});
    ASSERT_EQ(read.lists.size(), 1U);
    ASSERT_EQ(read.notes.size(), 4U);
    EXPECT_THAT(read.notes[0], HasSubstr("v.sol:3: the 1 entries of Time are not kept"));
    EXPECT_THAT(read.notes[2], HasSubstr("v.sol:5: the 2 entries of SolAtTriangles are not kept"));
    EXPECT_THAT(read.notes[3], HasSubstr("the file ends without the keyword End"));
}

/// A file, and the counts of the mesh that it is read for.
struct SolContent {
    SolContent(std::string file, const EntityCounts& of_mesh = {2, 1})  // NOLINT: rows state files
        : bytes(std::move(file)), counts(of_mesh) {}
    std::string bytes;
    EntityCounts counts;
};
using SolRows = std::vector<test::Refusal<SolContent>>;

/// Serial reading refuses the file `name`; collective reading leaves refusals to it.
template <const char* name>
void read_refused(const SolContent& content) {
    const TemporaryFolder folder;
    const auto file = folder.write(name, content.bytes);
    test::run_together(3, [&](const ProcessGroup& group) {
        EXPECT_FALSE(read_sol_share(file, content.counts, group));
    });
    (void)read_sol(file, content.counts);
}
constexpr char as_text[] = "v.sol";
constexpr char as_bytes[] = "v.solb";

const SolRows bad_sols{
    {"MoreVertices", head + "SolAtVertices\n3\n1 1\n1\n2\n3\nEnd\n", 4,
     "3 vertices announced, and the mesh has 2"},
    {"HugeCount", head + "SolAtTetrahedra\n18446744073709551615\n1 1\n1\nEnd\n", 4,
     "18446744073709551615 tetrahedra announced"},
    {"NoField", head + "SolAtVertices\n2\n0\nEnd\n", 5,
     "the number of fields should be from 1 to 1000, not 0"},
    {"HugeFieldCount", head + "SolAtVertices\n2\n99999999999999 1\n", 5,
     "the number of fields should be from 1 to 1000"},
    {"UnknownType", head + "SolAtVertices\n2\n2 1\n5\n1 1\n", 6,
     "the type of a field should be 1 (scalar)"},
    {"NaN", head + "SolAtVertices\n2\n1 1\n1\nnan\nEnd\n", 7, "a value is not finite: 'nan'"},
    {"BeyondMidpoints", head + "SolAtVertices\n2\n1 1\n1\n-9e307\nEnd\n", 7,
     "a value is -9e+307: values must be less than 2^1023"},
    {"NotANumber", head + "SolAtVertices\n2\n1 1\n1\nx\nEnd\n", 7,
     "a value should be a number, not 'x'"},
    {"EndsEarly", head + "SolAtVertices\n2\n1 1\n1\n", 6, "the file ends where a value should be"},
    {"ExtraValue", head + "SolAtVertices\n2\n1 1\n1\n2\n3\nEnd\n", 8,
     "a keyword expected, '3' found"},
    {"SecondSection", head + "SolAtVertices\n2\n1 1\n1\n2\nSolAtVertices\n2\n1 1\n1\n2\nEnd\n", 8,
     "a second section SolAtVertices"},
    {"ExtraValueOfAVector", head + "SolAtVertices\n2\n1 2\n1 2 3\n4 5 6 7\nEnd\n", 7,
     "a keyword expected, '7' found"},
    {"HugeSkippedSection", head + "SolAtEdges\n4000000000\n1 1\n", 5,
     "4000000000 rows of values announced, but a file of"},
    {"TextAfterEnd", head + "End\n5\n", 4, "text after the keyword End"},
    {"Dimension", head + "Dimension 2\n", 3, "dimension 3 expected"},
    {"VersionSeven", std::string("MeshVersionFormatted 7\n"), 1,
     "the Medit format has versions 1 to 4"},
    {"NoVersion", std::string("SolAtVertices\n"), 1,
     "a Medit file begins with MeshVersionFormatted"},
};

INSTANTIATE_TEST_SUITE_P(Sol, RefusedFiles,
                         test::refusals(as_text, read_refused<as_text>, bad_sols),
                         test::name_of_case);

/// Two vertices with a scalar and a vector, a cell with a scalar.
MeshbFile two_sections(int version, bool swapped) {
    MeshbFile file(version, swapped);
    file.dimension().section(62, 2);
    file.put<std::int32_t>(2).put<std::int32_t>(1).put<std::int32_t>(2);
    for (const double value : {1.0, 2.0, 3.0, 4.0, -5.0, 0.5, 0.25, 1e10}) file.real(value);
    file.section(66, 1).put<std::int32_t>(1).put<std::int32_t>(1).real(7);
    return file;
}

TEST(SolbReader, TakesEveryVersionInEitherByteOrder) {
    for (const int version : {1, 2, 3, 4}) {
        for (const bool swapped : {false, true}) {
            SCOPED_TRACE(testing::Message() << version << (swapped ? " swapped" : ""));
            const TemporaryFolder folder;
            const auto file = folder.write("v.solb", two_sections(version, swapped).end().bytes());
            EXPECT_TRUE(is_read_together(file, {2, 1}));
            const SolFields read = read_sol(file, EntityCounts{2, 1});
            ASSERT_EQ(read.lists.size(), 2U);
            EXPECT_THAT(read.lists[0].components, ElementsAre(1, 3));
            EXPECT_THAT(read.lists[0].values, ElementsAre(1, 2, 3, 4, -5, 0.5, 0.25, 1e10));
            EXPECT_EQ(read.lists[1].on, FieldOn::cells);
            EXPECT_THAT(read.lists[1].values, ElementsAre(7));
            EXPECT_THAT(read.notes, ElementsAre());
        }
    }
}

/// A section of values at the vertices, after 20 bytes: `numbers` are the integers behind `count`.
MeshbFile of_vertices(std::int64_t count, std::initializer_list<std::int32_t> numbers) {
    MeshbFile file = std::move(MeshbFile(2).dimension());
    file.section(62, count);
    for (const std::int32_t number : numbers) file.put(number);
    return file;
}

test::Refusal<SolContent> bad_solb(const std::string& name, const MeshbFile& file,
                                   const test::Place& place, const std::string& what,
                                   const EntityCounts& counts = {2, 1}) {
    return {name, SolContent(file.bytes(), counts), place, what};
}

SolRows bad_solbs() {
    using test::at_byte;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const MeshbFile good = two_sections(2, false).end();
    MeshbFile twice = two_sections(2, false);
    twice.section(62, 2).put<std::int32_t>(1).put<std::int32_t>(1).real(1).real(2).end();
    return {
        bad_solb("FewerVertices", good, at_byte(28), "2 vertices announced, and the mesh", {3, 1}),
        bad_solb("FewerCells", good, ": at byte ", "tetrahedra announced, and the mesh has 5",
                 {2, 5}),
        bad_solb("HugeFieldCount", of_vertices(2, {1001}).end(), at_byte(32),
                 "the number of fields should be from 1 to"),
        bad_solb("NegativeFieldCount", of_vertices(2, {-1}).end(), at_byte(32),
                 "the number of fields should be from 1 to"),
        bad_solb("UnknownType", of_vertices(2, {2, 1, 0}).end(), at_byte(40),
                 "the type of a field should be 1 (scalar)"),
        bad_solb("HugeCount", of_vertices(1 << 30, {1, 1}).real(1).end(), at_byte(28),
                 "1073741824 rows of values announced, but the 16 bytes", {1 << 30, 1}),
        bad_solb("CountTooSmall", of_vertices(2, {1, 1}).real(1).real(2).real(3).end(), at_byte(28),
                 "2 rows of values announced, which end at"),
        bad_solb("NaN", of_vertices(2, {1, 1}).real(1).real(nan).end(), at_byte(48),
                 "a value is not finite: nan"),
        bad_solb("BeyondMidpoints", of_vertices(2, {1, 1}).real(-1e308).real(1).end(), at_byte(40),
                 "a value is -1e+308: values must be less"),
        bad_solb("SecondSection", twice, ": at byte ", "a second section SolAtVertices"),
        bad_solb("UnknownKeyword", MeshbFile(2).dimension().keyword(-7).end(), at_byte(20),
                 "a keyword expected, -7 found"),
        bad_solb("Dimension", MeshbFile(2).dimension(2), at_byte(16),
                 "dimension 3 expected, 2 found"),
        {"Garbage", std::string("garbage!"), at_byte(0), "a binary Medit file"},
    };
}

INSTANTIATE_TEST_SUITE_P(Solb, RefusedFiles,
                         test::refusals(as_bytes, read_refused<as_bytes>, bad_solbs()),
                         test::name_of_case);

/// A file with one byte changed, or truncated anywhere, is read or refused.
TEST(SolbReader, ReadsOrRefusesFilesWithAnyByteChanged) {
    const std::string good = two_sections(2, false).end().bytes();
    const TemporaryFolder folder;
    std::mt19937 random(7);
    int read = 0;
    for (std::size_t at = 0; at < good.size(); ++at) {
        for (const char change : {'\x01', '\x80', static_cast<char>(random() | 1U)}) {
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ change);
            for (const std::string& bytes : {bad, good.substr(0, at)}) {
                const auto file = folder.write("v.solb", bytes);
                try {
                    read += read_sol(file, EntityCounts{2, 1}).lists.empty() ? 0 : 1;
                } catch (const InputError&) {
                    EXPECT_FALSE(read_sol_share(file, {2, 1}, ProcessGroup::alone()));
                }
            }
        }
    }
    EXPECT_GT(read, 50);  // those with changed values
}

}  // namespace
}  // namespace octetra
