#include <filesystem>

#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/mesh_files.hpp>

#include "support/temporary_folder.hpp"

/// ReadOptions::only_syntax accepts meshes that a verifier must be able to inspect, and refuses
/// those that it cannot.
namespace octetra {
namespace {

Mesh read_bad(const std::string& file, bool only_syntax) {
    const auto path = std::filesystem::path(OCTETRA_SOURCE_DIR) / "corpus" / "bad" / file;
    return read_mesh(path, {.only_syntax = only_syntax});
}

class WrongMesh : public testing::TestWithParam<std::string> {};

TEST_P(WrongMesh, IsReadUnchangedIfOnlySyntaxIsRequested) {
    EXPECT_THROW((void)read_bad(GetParam(), false), InputError);
    const Mesh mesh = read_bad(GetParam(), true);
    EXPECT_GE(mesh.cells.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(
    , WrongMesh,
    testing::Values("inverted-cell.ele", "flat-cell.ele", "nearly-flat-cell.ele",
                    "repeated-vertex.ele", "face-of-no-cell.ele", "face-with-repeated-vertex.ele",
                    "edge-of-no-cell.ele", "medit-inverted-cell.mesh", "medit-flat-cell.mesh",
                    "medit-repeated-vertex.mesh", "medit-face-of-no-cell.mesh",
                    "medit-edge-of-no-cell.mesh", "repeated-cell.ele", "three-cells-at-a-face.ele",
                    "face-with-two-markers.ele", "edge-with-two-markers.ele",
                    "medit-repeated-cell.mesh", "medit-overlapping-cells.mesh",
                    "medit-face-with-two-markers.mesh", "medit-edge-with-two-markers.mesh"),
    [](const auto& test_case) {
        std::string name = test_case.param;
        for (char& c : name) {
            if (c == '-' || c == '.') c = '_';
        }
        return name;
    });

class WrongFile : public testing::TestWithParam<std::string> {};

TEST_P(WrongFile, IsRefusedAllTheSame) {
    EXPECT_THROW((void)read_bad(GetParam(), true), InputError);
}

INSTANTIATE_TEST_SUITE_P(Indices, WrongFile,
                         testing::Values("index-out-of-range.ele", "face-index-out-of-range.ele",
                                         "nan.ele", "medit-index-out-of-range.mesh",
                                         "medit-inf.mesh", "region-not-whole.ele"));

TEST(OnlySyntax, LeavesInvertedCellsAsTheyAre) {
    const test::TemporaryFolder folder;
    (void)folder.write("a.node", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    (void)folder.write("a.ele", "1 4\n0 1 0 2 3\n");
    const Mesh mesh = read_mesh(folder / "a.ele", {.only_syntax = true});
    const Mesh fixed = read_mesh(folder / "a.ele", {.fix_orientation = true});
    EXPECT_NE(mesh.cells, fixed.cells);
}

}  // namespace
}  // namespace octetra
