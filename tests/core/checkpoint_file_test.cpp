#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>

#include "files/checkpoint/table.hpp"
#include "support/sealed_checkpoint.hpp"
#include "support/tagged_meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

/// The format of checkpoints, and the rejection of damaged or invalid files.
namespace octetra {
namespace {

constexpr Cut all_six = 127;

CutRuns runs(const std::vector<CutRun>& list) {
    CutRuns coded;
    for (const CutRun& run : list) coded.append(run.cut, run.count);
    coded.finish();
    return coded;
}

TEST(CutRuns, ReadBackAsWritten) {
    std::mt19937_64 random(1);
    for (int sequence = 0; sequence < 20; ++sequence) {
        std::vector<CutRun> list;
        for (Cut cut = 0; cut < 128; ++cut) {
            if (cut == one_child_more) continue;  // the pattern of no edges
            const std::uint64_t length =
                random() % 4 == 0 ? random() >> (random() % 60 + 2) : random() % 4;
            list.push_back({cut, length + 1});
        }
        std::vector<CutRun> found;
        for_each_run(runs(list), [&](Cut cut, std::uint64_t count) {
            found.push_back({cut, count});
        });
        EXPECT_EQ(found, list);
    }
}

TEST(CutRuns, MergeEqualNeighbours) {
    CutRuns one_by_one;
    for (int k = 0; k < 300; ++k) {
        one_by_one.append(9);
        one_by_one.append(0, 0);
    }
    one_by_one.finish();
    EXPECT_EQ(one_by_one, runs({{9, 300}}));
    EXPECT_EQ(one_by_one.bytes().size(), 3);
}

Mesh input() {
    Mesh mesh = test::tagged(test::kuhn(1, 1, 1));
    mesh.attributes_per_point = 1;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.point_attributes.push_back(static_cast<double>(v) / 3);
    }
    mesh.group_names = {{3, 1, "rock"}, {2, -5, "\"outer\" wall"}, {0, 9, "Größe"}};
    return mesh;
}

/// A step that bisects all edges, and one that bisects edges of the first two cells.
std::filesystem::path write_example(const std::filesystem::path& path) {
    const Mesh mesh = input();
    WholeMesh source(mesh);
    const MeshFacts& f = source.facts();
    const std::uint64_t cells = 8 * f.cells;
    CheckpointWriter writer(path, ProcessGroup::alone(),
                            {.vertices = f.vertices,
                             .cells = f.cells,
                             .facets = f.facets,
                             .edges = f.edges,
                             .attributes_per_point = 1,
                             .index_base = f.index_base,
                             .has_point_markers = f.has_point_markers,
                             .has_regions = f.has_regions,
                             .has_facet_markers = f.has_facet_markers,
                             .has_edge_markers = f.has_edge_markers,
                             .vertices_now = 5,
                             .cells_now = cells + 3,
                             .steps = std::vector<StepFacts>(2),
                             .fields = {{"u", FieldOn::vertices, FieldType::int32, 2}},
                             .group_names = mesh.group_names,
                             .state = SavedState{0.25, -3, "{\n\t\"dt\": 0.1}"}});
    writer.put_input(source);
    std::vector<std::byte> block;
    writer.put_section(Section::cuts, [&](const Window&) {
        block = cuts_block({runs({{all_six, f.cells}}), runs({{1, 1}, {6, 1}, {0, cells - 2}})},
                           writer.facts().steps);
        return std::span<const std::byte>(block);
    });
    const std::vector<std::int32_t> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    writer.put_section(field_section(0),
                       [&](const Window&) { return std::as_bytes(std::span(values)); });
    writer.commit();
    return path;
}

TEST(CheckpointFile, ReadsBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    const auto path = write_example(folder / "a.octetra");
    const Checkpoint read = read_checkpoint(path);
    const std::uint64_t cells = input().cells.size();
    EXPECT_EQ(read.input, input());
    ASSERT_EQ(read.steps.size(), 2);
    EXPECT_EQ(read.steps[0], std::vector<std::uint8_t>(cells, 63));
    EXPECT_EQ(read.steps[1].size(), 8 * cells);
    EXPECT_EQ(read.steps[1][1], 6);
    EXPECT_EQ(read.facts.steps[0], (StepFacts{cells, cells, 2}));
    EXPECT_EQ(read.facts.steps[1].cells_cut, 2);
    EXPECT_EQ(read.facts.state, (SavedState{0.25, -3, "{\n\t\"dt\": 0.1}"}));
    const CheckpointReader reader(path);
    EXPECT_EQ(reader.read<std::int32_t>(field_section(0), 1, 3),
              (std::vector<std::int32_t>{3, 4, 5, 6}));
}

/// Reads the whole file unless it is refused. Any outcome but an InputError that names the file
/// fails the test.
bool is_refused(const std::filesystem::path& path) {
    try {
        const CheckpointReader reader(path);
        for (std::size_t s = 0; s < section_count(reader.facts()); ++s) {
            const auto section = static_cast<Section>(s);
            const SectionShape shape = shape_of(reader.facts(), section);
            for (std::uint64_t b = 0; b < shape.blocks(); ++b) (void)reader.read_block(section, b);
        }
        (void)read_checkpoint(path);
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find(path.native() + ": "), 0) << error.what();
        return true;
    }
    return false;
}

TEST(CheckpointFile, OfWhichAnyByteIsAnotherIsRefused) {
    const test::TemporaryFolder folder;
    const std::string good = test::content_of(write_example(folder / "a.octetra"));
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
        EXPECT_TRUE(is_refused(folder.write("bad.octetra", bad))) << "byte " << i;
    }
}

TEST(CheckpointFile, ThatIsTruncatedOrLongerIsRefused) {
    const test::TemporaryFolder folder;
    const std::string good = test::content_of(write_example(folder / "a.octetra"));
    for (std::size_t size = 0; size < good.size(); ++size) {
        EXPECT_TRUE(is_refused(folder.write("bad.octetra", good.substr(0, size)))) << size;
    }
    EXPECT_TRUE(is_refused(folder.write("bad.octetra", good + '\0')));
    EXPECT_FALSE(is_refused(folder.write("good.octetra", good)));
}

TEST(CheckpointFile, ReportsTheDamagedBlockAndItsHash) {
    const test::TemporaryFolder folder;
    std::string bad = test::content_of(write_example(folder / "a.octetra"));
    bad[20] = static_cast<char>(bad[20] + 1);  // of the first point
    const auto path = folder.write("bad.octetra", bad);
    const std::string what = test::thrown_by<InputError>([&] { (void)read_checkpoint(path); });
    EXPECT_NE(what.find("block 0 of the points: damaged: its hash is "), std::string::npos) << what;
}

TEST(CheckpointFile, InventedWithRightHashesIsReadOrRefused) {
    const test::TemporaryFolder folder;
    const std::string good = test::content_of(write_example(folder / "a.octetra"));
    std::mt19937_64 random(1);
    int read = 0;
    for (int k = 0; k < 4000; ++k) {
        std::string bad = good;
        for (std::uint64_t n = random() % 3; n < 3; ++n) {
            bad[random() % (bad.size() - sizeof(CheckpointTrailer))] =
                static_cast<char>(random() % 2 == 0 ? random() : 0xff);
        }
        test::seal(bad);
        read += is_refused(folder.write("bad.octetra", bad)) ? 0 : 1;
    }
    EXPECT_GT(read, 0);  // some of these are different meshes
    EXPECT_LT(read, 4000);
}

TEST(CheckpointFile, WithWrongFiguresOfAStepInItsTableIsRefusedWithPosition) {
    const test::TemporaryFolder folder;
    const std::string good = test::content_of(write_example(folder / "a.octetra"));
    std::uint64_t table = 0;
    std::memcpy(&table, good.data() + good.size() - 32, sizeof table);
    for (std::size_t number = 0; number < 6; ++number) {
        std::string bad = good;
        ++bad[table + 80 + 8 * number];
        test::seal(bad);
        const auto path = folder.write("bad.octetra", bad);
        const std::string what = test::thrown_by<InputError>([&] { (void)read_checkpoint(path); });
        const std::size_t step = number / 3;
        const std::string place = path.native() + ": at byte " +
                                  std::to_string(table + 80 + 24 * step) + ": the table has ";
        EXPECT_EQ(what.find(place), 0) << what;
        EXPECT_NE(what.find(" cells before step " + std::to_string(step + 1)), std::string::npos);
    }
}

/// One byte differs in the names of groups, or in the fields before them in the table.
TEST(CheckpointFile, WithNamesOfGroupsThatNoMeshHasIsRefused) {
    const test::TemporaryFolder folder;
    const std::string good = test::content_of(write_example(folder / "a.octetra"));
    const std::size_t rock = good.find("rock");
    ASSERT_NE(rock, std::string::npos);
    const auto edited = [&](std::size_t at, char byte) {
        std::string bad = good;
        bad[at] = byte;
        test::seal(bad);
        return test::thrown_by<InputError>(
            [&] { (void)read_checkpoint(folder.write("bad.octetra", bad)); });
    };
    using testing::HasSubstr;
    EXPECT_THAT(edited(rock, '\n'),
                HasSubstr("the name of group 1 of dimension 3 is empty or not printable"));
    EXPECT_THAT(edited(rock, '\xff'), HasSubstr("not printable"));
    EXPECT_THAT(edited(rock - 24, 4), HasSubstr("as a dimension"));
    EXPECT_THAT(edited(rock - 10, 1), HasSubstr("the tag of a group is out of range"));
    std::string twice = good;
    const std::size_t size = good.find("Gr\xc3\xb6") - 24;
    twice[size] = 2;
    for (std::size_t k = 8; k < 16; ++k) twice[size + k] = k == 8 ? '\xfb' : '\xff';
    test::seal(twice);
    EXPECT_THAT(test::thrown_by<InputError>(
                    [&] { (void)read_checkpoint(folder.write("bad.octetra", twice)); }),
                HasSubstr("group -5 of dimension 2 has two names"));
}

TEST(CheckpointFile, OfAnotherFormatIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(is_refused(folder.write("a.octetra", "MeshVersionFormatted 2\nDimension 3\n")));
    EXPECT_TRUE(is_refused(folder.path()));
    EXPECT_TRUE(is_refused(folder / "nothing.octetra"));
    std::string newer = test::content_of(write_example(folder / "b.octetra"));
    newer[8] = 2;
    EXPECT_TRUE(is_refused(folder.write("newer.octetra", newer)));
}

TEST(FieldName, IsTextThatCanBePrinted) {
    for (const std::string_view name : {"u", "Größe", "速度", "a b", "\xf4\x8f\xbf\xbf", ""}) {
        EXPECT_TRUE(is_name(name)) << name;
    }
    for (const std::string_view name :
         {"\x1b[2J", "a\nb", "\x7f", "\xc2\x9b", "\xff", "\xc3", "\xc3z", "\x80", "\xc0\x80",
          "\xe0\x80\x80", "\xf0\x80\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
          "\xf5\x80\x80\x80"}) {
        EXPECT_FALSE(is_name(name)) << name;
    }
}

}  // namespace
}  // namespace octetra
