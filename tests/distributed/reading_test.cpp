#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/refine.hpp>
#include <octetra/reference/refine.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/mesh_texts.hpp"
#include "distributed/outcomes.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"

/// Collective reading yields the mesh of serial reading, or its error message.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::are_read_together;
using test::expect_one_outcome;
using test::Files;
using test::files_of;
using test::mutated;
using test::partitions;
using test::replaced;
using test::write_on_first;

/// The meshes in a folder, by the names that commands accept.
std::vector<fs::path> meshes_in(const fs::path& folder) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        fs::path file = entry.path();
        for (const char* const extension : {".mesh", ".meshb", ".msh"}) {
            if (file.extension() == extension) files.insert(file);
        }
        if (file.extension() != ".ele" && file.extension() != ".node") continue;
        const fs::path ele = fs::path(file).replace_extension(".ele");
        files.insert(fs::exists(ele) ? ele : file);
    }
    return {files.begin(), files.end()};
}

fs::path corpus(const std::string& folder) {
    return fs::path(OCTETRA_SOURCE_DIR) / "corpus" / folder;
}

TEST(ReadTogether, EveryMeshOfTheCorpusEqualsThatOfSerialReading) {
    int alone = 0;
    for (const fs::path& file : meshes_in(corpus("meshes"))) {
        if (!test::is_read_together(file)) ++alone;
        for (const std::string& partition : partitions) {
            EXPECT_TRUE(test::expect_one_outcome(file, partition)) << file;
        }
    }
    EXPECT_EQ(alone, test::world().size() > 1 ? 1 : 0);  // all on one line
}

TEST(ReadTogether, EveryBadFileOfTheCorpusIsRefusedWithTheMessageOfSerialReading) {
    const std::vector<fs::path> files = meshes_in(corpus("bad"));
    EXPECT_GE(files.size(), 60U);
    for (const fs::path& file : files) EXPECT_FALSE(test::expect_one_outcome(file, "rcb")) << file;
}

TEST(ReadTogether, MeshesWithEverythingEqualThoseOfSerialReading) {
    for (const std::string extension : {".ele", ".mesh", ".meshb"}) {
        for (const std::uint32_t index_base : {0U, 1U}) {
            for (const std::size_t n : {1U, 2U, 6U}) {
                const Files files =
                    files_of(test::featured(test::full_mesh(n, index_base), n), extension);
                EXPECT_TRUE(are_read_together(files)) << extension << ' ' << n;
                EXPECT_TRUE(expect_one_outcome(files)) << extension << ' ' << n;
            }
        }
    }
}

/// In a lattice many centroids have equal coordinates, and numbers break the ties.
TEST(ReadTogether, PartsAreThoseThatOneProcessWouldMake) {
    for (const Mesh& mesh : {test::full_mesh(5, 1), test::kuhn(5, 4, 3)}) {
        const test::SharedFolder folder;
        const fs::path file = folder / "m.ele";
        write_on_first([&] { (void)write_mesh(mesh, file); });
        for (const std::string& name : partitions) {
            const auto partition = distributed::parse_partition(name);
            const auto ranks = distributed::partition_cells(mesh, test::world().size(), partition);
            std::vector<std::uint64_t> expected;
            for (std::size_t c = 0; c < ranks.size(); ++c) {
                if (ranks[c] == test::world().rank()) expected.push_back(c);
            }
            const auto part = distributed::read_parts(test::world(), file, partition);
            EXPECT_EQ(part.cell_ancestors.roots, expected) << name;
        }
        (void)test::world().max(0);
    }
}

/// Collecting does not check interfaces, but closure depends on them.
TEST(ReadTogether, MeshesAreRefinedAsTheReferenceRefinesThem) {
    const Selection selection{.random = RandomShare{0.1, 3}};
    const test::SharedFolder folder;
    for (const std::size_t n : {2U, 5U}) {
        const fs::path file = folder / fmt::format("{}.ele", n);
        write_on_first([&] { (void)write_mesh(test::full_mesh(n, 1), file); });
        const auto expected = reference::refine(read_mesh(file), selection, Scheme::eight, 2).mesh;
        for (const std::string& partition : partitions) {
            auto parts = distributed::read_parts(test::world(), file,
                                                 distributed::parse_partition(partition));
            distributed::refine(parts, selection, {.levels = 2});
            const Mesh found = collect(std::move(parts)).mesh;
            EXPECT_TRUE(!test::world().is_first() || found == expected) << n << partition;
        }
    }
    (void)test::world().max(0);
}

/// Every process has many messages of cells.
TEST(ReadTogether, AMeshOfManyCellsEqualsThatOfSerialReading) {
    Mesh mesh = test::kuhn(34, 33, 32, 1.0 / 3);
    test::list_boundary(mesh);
    for (const std::string extension : {".ele", ".meshb"}) {
        const Files files = files_of(mesh, extension);
        EXPECT_TRUE(are_read_together(files));
        EXPECT_TRUE(expect_one_outcome(files));
    }
}

/// Forms of the same files that are read collectively.
TEST(ReadTogether, CommentsBlanksAndLineEndsAreSkipped) {
    for (const std::string extension : {".ele", ".mesh"}) {
        const Files plain = files_of(test::full_mesh(2, 1), extension);
        const auto with = [&](const auto& change) {
            Files files = plain;
            for (auto& [ending, text] : files.texts) text = change(text);
            EXPECT_TRUE(are_read_together(files)) << extension;
            EXPECT_TRUE(expect_one_outcome(files)) << extension;
        };
        with([](const auto& text) { return replaced(text, "\n", "\r\n"); });
        with([](const auto& text) { return replaced(text, "\n", "\n\n \t\n"); });
        with([](const auto& text) { return replaced(text, "\n", " # Triangles\n  # End\n"); });
        with([](const auto& text) { return "# a comment\n\n" + text; });
        with([](const auto& text) { return "\xef\xbb\xbf" + text; });
        with([](const auto& text) { return text.substr(0, text.size() - 1); });
        with([](const auto& text) { return text + std::string(5000, '\n'); });
        with([](const auto& text) { return text + "#" + std::string(20000, 'x'); });
        with([](const auto& text) { return replaced(text, "\n", "\n\t "); });
        with([](const auto& text) { return replaced(text, " ", " \t  "); });
    }
}

TEST(ReadTogether, FilesChangedAtRandomHaveTheOutcomeOfSerialReading) {
    const char* const given = std::getenv("OCTETRA_READING_SEED");
    std::vector<std::uint64_t> seed{given != nullptr ? std::strtoull(given, nullptr, 10)
                                                     : std::random_device()()};
    test::world().broadcast(seed);
    SCOPED_TRACE(fmt::format("OCTETRA_READING_SEED={}", seed.front()));
    std::mt19937_64 random(seed.front());
    const std::vector<Files> files{files_of(test::full_mesh(1, 0), ".ele"),
                                   files_of(test::full_mesh(1, 1), ".ele"),
                                   files_of(test::featured(test::full_mesh(1, 1), 3), ".mesh"),
                                   files_of(test::featured(test::full_mesh(1, 1), 3), ".meshb")};
    int meshes = 0;
    // With more processes than cores each turn is slow.
    const int turns = OCTETRA_SANITIZED ? 100 : test::world().size() > 3 ? 200 : 1000;
    for (int turn = 0; turn < turns; ++turn) {
        Files changed = files[random() % files.size()];
        std::string& text = changed.texts[random() % changed.texts.size()].second;
        text = mutated(std::move(text), random);
        if (expect_one_outcome(changed)) ++meshes;
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
