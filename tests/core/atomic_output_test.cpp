#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/lists.hpp>
#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/maps.hpp>

#include "support/full_disk.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/thrown.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
}

TEST(WriteMesh, LeavesItsFilesAndNothingElse) {
    const TemporaryFolder folder;
    Mesh mesh = test::kuhn(1, 1, 1);
    test::list_boundary(mesh);
    (void)write_mesh(mesh, folder / "a.ele");
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a.ele", "a.face", "a.node"));
}

TEST(WriteMesh, ThatFailsLeavesTheOldFile) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(1, 1, 1);
    (void)write_mesh(mesh, folder / "a.ele");
    const std::string before = test::content_of(folder / "a.node");
    // The second file of the set cannot be renamed: a folder has its name.
    std::filesystem::remove(folder / "a.ele");
    std::filesystem::create_directory(folder / "a.ele");
    EXPECT_THROW((void)write_mesh(test::kuhn(2, 2, 2), folder / "a.node"), InputError);
    EXPECT_EQ(test::content_of(folder / "a.node"), before);
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a.ele", "a.node"));
}

TEST(WriteMesh, RemovesNoFolderWithTheNameOfAList) {
    for (const std::string extension : {"face", "edge"}) {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder / ("a." + extension));
        EXPECT_THAT(test::thrown_by<InputError>(
                        [&] { (void)write_mesh(test::kuhn(1, 1, 1), folder / "a.ele"); }),
                    HasSubstr("a." + extension + ": is a directory"));
        EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a." + extension));
    }
}

TEST(WriteMesh, ReplacesOnlyFiles) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(1, 1, 1);
    ASSERT_EQ(::mkfifo((folder / "a.mesh").c_str(), 0600), 0);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "a.mesh"); }),
                HasSubstr("a.mesh: is not a regular file"));
    ASSERT_EQ(::mkfifo((folder / "a.node").c_str(), 0600), 0);
    EXPECT_THROW((void)write_mesh(mesh, folder / "a.ele"), InputError);
    const RefinementMaps maps{.first_midpoint = mesh.points.end_index()};
    WholeMesh source(mesh, &maps);
    EXPECT_THROW(write_maps(source, folder / "a.node"), SystemError);
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "a.mesh"));
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "a.node"));
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a.mesh", "a.node"));
}

TEST(WriteMesh, RefusesUnknownExtensionsAndMissingFolders) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(1, 1, 1);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "a.stl"); }),
                HasSubstr("a.stl: the extension of a mesh to write must be"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "a.octetra"); }),
                HasSubstr("a.octetra: a checkpoint is written by AdaptiveMesh::save"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)read_mesh(folder / "a.octetra"); }),
                HasSubstr("a.octetra: a checkpoint is loaded by AdaptiveMesh::load"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "x/a.vtu"); }),
                HasSubstr("create it first"));
    std::filesystem::create_directory(folder / "d.vtu");
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "d.vtu"); }),
                HasSubstr("is a directory"));
}

TEST(WriteMesh, ReportsAFullDiskAndLeavesNothing) {
    const TemporaryFolder folder;
    const Mesh mesh = test::kuhn(4, 4, 4);
    for (const std::string extension : {"ele", "mesh", "meshb", "vtu", "vtkhdf", "xdmf", "h5"}) {
        const test::FullDisk disk("a." + extension + ".");
        const std::string name = extension == "h5" ? "a.xdmf" : "a." + extension;  // its values
        EXPECT_THAT(test::thrown_by<SystemError>([&] { (void)write_mesh(mesh, folder / name); }),
                    HasSubstr("a." + extension + ": writing failed: No space left on device"));
        EXPECT_THAT(names_in(folder.path()), testing::ElementsAre());
    }
}

TEST(WriteText, ReplacesAFileWholeOrNotAtAll) {
    const TemporaryFolder folder;
    write_text("one\n", folder / "a.json");
    write_text("two\n", folder / "a.json");
    EXPECT_EQ(test::content_of(folder / "a.json"), "two\n");
    const test::FullDisk disk("a.json.");
    EXPECT_THAT(test::thrown_by<SystemError>([&] { write_text("three", folder / "a.json"); }),
                HasSubstr("No space left on device"));
    EXPECT_EQ(test::content_of(folder / "a.json"), "two\n");
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("a.json"));
}

}  // namespace
}  // namespace octetra
