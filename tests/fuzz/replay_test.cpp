#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/check_readers.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

/// Files on which readers once failed, and those of the corpus, read as in fuzzing.
namespace octetra::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path corpus = fs::path(OCTETRA_SOURCE_DIR) / "corpus";

std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension = {}) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const bool fits = extension.empty() || entry.path().extension() == extension;
        if (entry.is_regular_file() && fits) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

/// The files of a TetGen mesh in the form that check_tetgen takes.
std::string in_one(fs::path path) {
    std::string joined;
    for (const std::string extension : {".node", ".ele", ".face", ".edge"}) {
        if (!joined.empty()) joined += '%';
        path.replace_extension(extension);
        joined += fs::exists(path) ? content_of(path) : "-";
    }
    return joined;
}

TEST(KeptFile, IsReadOrRefusedCorrectly) {
    const TemporaryFolder folder;
    for (const auto& kept : fs::directory_iterator(corpus / "regression" / "files")) {
        const std::string name = kept.path().filename();
        const auto reader = std::ranges::find(reader_checks(), name, &NamedCheck::name);
        ASSERT_NE(reader, reader_checks().end()) << "there is no reader " << name;
        for (const fs::path& file : files_in(kept.path())) {
            SCOPED_TRACE(file);
            EXPECT_NO_THROW(reader->check(content_of(file), folder.path()));
        }
    }
}

TEST(CorpusFile, IsReadOrRefusedCorrectly) {
    const TemporaryFolder folder;
    for (const fs::path& meshes : {corpus / "meshes", corpus / "bad"}) {
        for (const fs::path& file : files_in(meshes, ".ele")) {
            SCOPED_TRACE(file);
            EXPECT_NO_THROW(check_tetgen(in_one(file), folder.path()));
        }
        for (const fs::path& file : files_in(meshes, ".mesh")) {
            SCOPED_TRACE(file);
            EXPECT_NO_THROW(check_medit(content_of(file), folder.path()));
        }
        for (const fs::path& file : files_in(meshes, ".msh")) {
            SCOPED_TRACE(file);
            EXPECT_NO_THROW(check_gmsh(content_of(file), folder.path()));
        }
    }
}

/// Also with single bytes replaced at random.
TEST(KeptCheckpoint, IsReadOrRefusedCorrectly) {
    const TemporaryFolder folder;
    const std::string good = content_of(corpus / "checkpoints" / "version-1.octetra");
    check_checkpoint(good, folder.path());
    std::mt19937_64 random(1);
    for (int k = 0; k < 300; ++k) {
        std::string bad = good;
        bad[random() % bad.size()] = static_cast<char>(random());
        EXPECT_NO_THROW(check_checkpoint(bad, folder.path())) << "number " << k;
    }
}

std::uint64_t gmsh_seed() {
    const char* const given = std::getenv("OCTETRA_GMSH_SEED");
    return given == nullptr ? std::random_device{}() : std::strtoull(given, nullptr, 10);
}

/// Replaces, removes and duplicates bytes. (The replacements include bytes that are frequent in
/// files.)
std::string edited(std::string file, std::mt19937_64& random) {
    constexpr std::array<char, 8> likely{'\0', '\1', '\4', '\xff', '\x7f', '9', '-', '\n'};
    for (std::uint64_t edits = 1 + random() % 3; edits > 0 && !file.empty(); --edits) {
        const std::size_t place = random() % file.size();
        const std::size_t length = 1 + random() % 12;
        switch (random() % 4) {
            case 0: file[place] = static_cast<char>(random()); break;
            case 1: file[place] = likely[random() % likely.size()]; break;
            case 2: file.erase(place, length); break;
            default: file.insert(random() % file.size(), file.substr(place, length)); break;
        }
    }
    return file;
}

std::uint64_t sol_seed() {
    const char* const given = std::getenv("OCTETRA_SOL_SEED");
    return given == nullptr ? std::random_device{}() : std::strtoull(given, nullptr, 10);
}

/// Unmodified, and edited at random.
TEST(CorpusFields, AreReadOrRefusedCorrectly) {
    const TemporaryFolder folder;
    const std::uint64_t seed = sol_seed();
    std::mt19937_64 random(seed);
    for (const std::string extension : {".sol", ".solb"}) {
        const CheckReader check = extension == ".sol" ? check_sol : check_solb;
        for (const fs::path& file : files_in(corpus / "fields", extension)) {
            SCOPED_TRACE(file);
            const std::string good = content_of(file);
            EXPECT_NO_THROW(check(good, folder.path()));
            for (int k = 0; k < 100; ++k) {
                EXPECT_NO_THROW(check(edited(good, random), folder.path()))
                    << "OCTETRA_SOL_SEED=" << seed << ", number " << k;
            }
        }
    }
}

/// OCTETRA_GMSH_SEED sets the seed.
TEST(EditedGmshFile, IsReadOrRefusedCorrectly) {
    const TemporaryFolder folder;
    const std::uint64_t seed = gmsh_seed();
    SCOPED_TRACE(testing::Message() << "OCTETRA_GMSH_SEED=" << seed);
    std::mt19937_64 random(seed);
    std::size_t read = 0;
    for (const fs::path& file : files_in(corpus / "meshes", ".msh")) {
        const std::string good = content_of(file);
        for (int k = 0; k < 150; ++k) {
            const std::string bad = edited(good, random);
            ASSERT_NO_THROW(check_gmsh(bad, folder.path())) << file << ", edit " << k;
            ++read;
        }
    }
    EXPECT_GE(read, 600U);
}

/// Data that no reader may return are distinguished from valid data.
TEST(BrokenInvariant, IsSeen) {
    const Mesh good = one_cell(cube_corner);
    EXPECT_EQ(broken_invariant(good, false), "");
    const auto broken = [&](auto&& fault, bool only_syntax = false) {
        Mesh mesh = good;
        fault(mesh);
        return broken_invariant(mesh, only_syntax);
    };
    const CellIndex cell{0};
    const auto vertex = [](std::size_t number) { return VertexIndex{number}; };
    const auto invert = [&](Mesh& mesh) { std::swap(mesh.cells[cell][0], mesh.cells[cell][1]); };
    const auto list_stray_edge = [&](Mesh& mesh) {
        mesh.points.append({2, 2, 2});
        mesh.edges.append({vertex(0), vertex(4)});
    };
    const auto leave_range = [&](Mesh& mesh) { mesh.cells[cell][3] = vertex(4); };
    EXPECT_THAT(broken([](Mesh& mesh) { mesh.index_base = 2; }), HasSubstr("index base"));
    EXPECT_THAT(broken([](Mesh& mesh) { mesh.regions.resize(2); }), HasSubstr("length"));
    EXPECT_THAT(broken([](Mesh& mesh) { mesh.attributes_per_point = 1; }), HasSubstr("length"));
    EXPECT_THAT(broken([&](Mesh& mesh) { mesh.points[vertex(0)].y = HUGE_VAL; }),
                HasSubstr("coordinate"));
    EXPECT_THAT(broken(leave_range), HasSubstr("range"));
    EXPECT_THAT(broken(leave_range, true), HasSubstr("range"));
    EXPECT_THAT(broken([&](Mesh& mesh) { mesh.cells[cell][3] = vertex(0); }), HasSubstr("twice"));
    EXPECT_THAT(broken(invert), HasSubstr("oriented"));
    EXPECT_EQ(broken(invert, true), "");
    EXPECT_THAT(broken(list_stray_edge), HasSubstr("an edge is of no cell"));
    EXPECT_EQ(broken(list_stray_edge, true), "");
    const auto repeat = [&](Mesh& mesh) { mesh.cells.append(mesh.cells[cell]); };
    EXPECT_THAT(broken(repeat), HasSubstr("same vertices"));
    EXPECT_EQ(broken(repeat, true), "");
    const auto list_face = [&](Mesh& mesh, Marker marker) {
        mesh.facets.append({vertex(0), vertex(1), vertex(2)});
        mesh.facet_markers.append(marker);
    };
    const auto list_edge = [&](Mesh& mesh, Marker marker) {
        mesh.edges.append({vertex(0), vertex(1)});
        mesh.edge_markers.append(marker);
    };
    EXPECT_EQ(broken([&](Mesh& mesh) {
                  list_face(mesh, 1), list_face(mesh, 1), list_edge(mesh, 2), list_edge(mesh, 2);
              }),
              "");
    EXPECT_THAT(broken([&](Mesh& mesh) { list_face(mesh, 1), list_face(mesh, 2); }),
                HasSubstr("facet has two markers"));
    EXPECT_THAT(broken([&](Mesh& mesh) { list_edge(mesh, 1), list_edge(mesh, 2); }),
                HasSubstr("edge has two markers"));
    const auto overlap = [&](Mesh& mesh) {
        mesh.points.append({0.25, 0.25, 0.5});
        mesh.cells.append({vertex(0), vertex(1), vertex(2), vertex(4)});
    };
    EXPECT_EQ(broken(overlap), "");  // of a face that is not tagged
    EXPECT_THAT(broken([&](Mesh& mesh) { overlap(mesh), list_face(mesh, 1); }),
                HasSubstr("same side"));
}

TEST(Message, ThatNamesNoFileAndLineIsSeen) {
    const TemporaryFolder folder;
    (void)folder.write("in.mesh", "one\ntwo\n");
    const std::string file = folder / "in.mesh";
    const auto check = [&](const std::string& message) { check_message(message, folder.path()); };
    EXPECT_NO_THROW(check(file + ": cannot be opened"));
    EXPECT_NO_THROW(check(file + ":1: what is wrong"));
    EXPECT_NO_THROW(check(file + ":3: the end is missing"));
    EXPECT_NO_THROW(check(file + ": at byte 0: what is wrong"));
    EXPECT_NO_THROW(check(file + ": at byte 8: the end is missing"));
    for (const std::string& wrong :
         {std::string("what is wrong"), file, file + ":0: what", file + ":4: what", file + ":2",
          file + ": at byte 9: what", file + ": at byte : what", file + ": at byte 1",
          file + ": at byte 1: ", file + ":1: a bell \a rings", file + ":1: two\nlines",
          file + ":1: \xff"}) {
        EXPECT_THROW(check(wrong), BrokenPromise) << wrong;
    }
}

}  // namespace
}  // namespace octetra::test
