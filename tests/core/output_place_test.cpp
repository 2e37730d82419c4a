#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
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

/// Outputs through links, and outputs that replace files with permissions of their own.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
}

Mesh mesh_with_facets() {
    Mesh mesh = test::kuhn(1, 1, 1);
    test::list_boundary(mesh);
    return mesh;
}

unsigned mode_of(const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_mode & 07777U;
}

constexpr unsigned nobody = 65534;

/// Runs `work` in a process of the user nobody, to whom permissions apply in contrast to root.
/// Returns the message that it threw, or "". Makes the folder accessible to everybody.
std::string as_nobody(const TemporaryFolder& folder, const std::function<void()>& work) {
    fs::permissions(folder.path(), fs::perms::all);
    const pid_t child = ::fork();
    if (child == 0) {
        int status = EXIT_FAILURE;
        if (::geteuid() != 0 || (::setgid(nobody) == 0 && ::setuid(nobody) == 0)) {
            status = EXIT_SUCCESS;
            std::string thrown;
            try {
                work();
            } catch (const std::exception& error) {
                thrown = error.what();
            }
            test::write_file(folder / "thrown", thrown);
        }
        ::_exit(status);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    const std::string thrown = content_of(folder / "thrown");
    fs::remove(folder / "thrown");
    return thrown;
}

TEST(OutputLinks, AreWrittenWhereTheyPointAndStayLinks) {
    const Mesh mesh = mesh_with_facets();
    for (const bool dangling : {false, true}) {
        for (const std::string extension : {"node", "mesh", "vtu", "pvtu"}) {
            SCOPED_TRACE(extension + (dangling ? ", dangling" : ""));
            const TemporaryFolder folder;
            fs::create_directories(folder / "store/deep");
            // A chain: absolute, then relative to a folder that is itself a link.
            fs::create_symlink("store/deep", folder / "short");
            const std::string name = "a." + extension;
            fs::create_symlink(folder / "store/b", folder / name);
            fs::create_symlink("../short/c", folder / "store/b");
            if (!dangling) test::write_file(folder / "store/deep/c", "as it was");
            (void)write_mesh(mesh, folder / name);
            (void)write_mesh(mesh, folder / ("plain." + extension));
            EXPECT_TRUE(fs::is_symlink(folder / name));
            EXPECT_TRUE(fs::is_symlink(folder / "store/b"));
            EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "store/deep/c")));
            EXPECT_THAT(names_in(folder / "store/deep"), ElementsAre("c"));
            if (extension == "pvtu") {
                EXPECT_THAT(content_of(folder / "store/deep/c"), HasSubstr("Source=\"a_0.vtu\""));
            } else {
                EXPECT_TRUE(content_of(folder / "store/deep/c") ==
                            content_of(folder / ("plain." + extension)));
            }
        }
    }
}

TEST(OutputLinks, OfEveryFileOfASetAndBesideTheMeshAreFollowed) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    const std::vector<std::string> names{"a.node", "a.ele", "a.face", "p_0.vtu",
                                         "maps",   "list",  "text"};
    for (const std::string& name : names) fs::create_symlink("store/" + name, folder / name);
    const Mesh mesh = mesh_with_facets();
    (void)write_mesh(mesh, folder / "a.ele");
    (void)write_mesh(mesh, folder / "p.pvtu");
    RefinementMaps maps{.first_midpoint = mesh.points.end_index()};
    maps.cell_to_parent.assign(mesh.cells.size(), CellIndex{0});
    WholeMesh source(mesh, &maps);
    write_maps(source, folder / "maps");
    write_list({1, 2}, folder / "list");
    write_text("text", folder / "text");
    for (const std::string& name : names) {
        EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
        EXPECT_TRUE(fs::is_regular_file(folder / "store" / name)) << name;
    }
    EXPECT_EQ(read_mesh(folder / "store/a.ele"), mesh);
    EXPECT_EQ(content_of(folder / "store/text"), "text");
}

TEST(OutputLinks, ThatLeadInACircleOrNowhereAreRefused) {
    const TemporaryFolder folder;
    fs::create_symlink("b.mesh", folder / "a.mesh");
    fs::create_symlink("a.mesh", folder / "b.mesh");
    fs::create_symlink("no/c.mesh", folder / "c.mesh");
    const Mesh mesh = test::kuhn(1, 1, 1);
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "a.mesh"); }),
                HasSubstr("a.mesh: is a link that refers to itself through other links"));
    EXPECT_THAT(test::thrown_by<SystemError>([&] { write_text("text", folder / "a.mesh"); }),
                HasSubstr("a.mesh: is a link that refers to itself through other links"));
    EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / "c.mesh"); }),
                HasSubstr("create it first"));
    EXPECT_THAT(names_in(folder.path()), ElementsAre("a.mesh", "b.mesh", "c.mesh"));
}

TEST(OutputLinks, ThatCannotBeWrittenLeaveTheirTargets) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    test::write_file(folder / "store/b.mesh", "as it was");
    fs::create_symlink("store/b.mesh", folder / "a.mesh");
    const test::FullDisk disk("b.mesh.");  // the temporary file is beside the target of the link
    EXPECT_THAT(test::thrown_by<SystemError>(
                    [&] { (void)write_mesh(test::kuhn(1, 1, 1), folder / "a.mesh"); }),
                HasSubstr("a.mesh: writing failed: No space left on device"));
    EXPECT_EQ(content_of(folder / "store/b.mesh"), "as it was");
    EXPECT_THAT(names_in(folder / "store"), ElementsAre("b.mesh"));
    EXPECT_THAT(names_in(folder.path()), ElementsAre("a.mesh", "store"));
}

TEST(OutputLinks, ThatLeadToOneFileAreRefused) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.node", "a.ele", "p.pvtu", "p_0.vtu"}) {
        fs::create_symlink("one", folder / name);
    }
    const Mesh mesh = test::kuhn(1, 1, 1);
    for (const std::string output : {"a.ele", "p.pvtu"}) {
        EXPECT_THAT(test::thrown_by<InputError>([&] { (void)write_mesh(mesh, folder / output); }),
                    HasSubstr("lead to the same file"));
    }
    EXPECT_FALSE(fs::exists(folder / "one"));
}

/// Files that would be read with the new mesh are removed, under any name, and no others.
TEST(OutputLinks, OfListsThatTheMeshDoesNotHaveAreRemovedButNotTheirTargets) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    for (const std::string name : {"store/b.node", "store/b.ele", "store/b.face", "shared.face",
                                   "shared.edge", "store/other.edge"}) {
        test::write_file(folder / name, "of another mesh");
    }
    fs::create_symlink("store/b.node", folder / "a.node");
    fs::create_symlink("store/b.ele", folder / "a.ele");
    fs::create_symlink("shared.face", folder / "a.face");
    fs::create_symlink("shared.edge", folder / "a.edge");
    const Mesh mesh = test::kuhn(1, 1, 1);
    (void)write_mesh(mesh, folder / "a.ele");
    EXPECT_THAT(names_in(folder.path()),
                ElementsAre("a.ele", "a.node", "shared.edge", "shared.face", "store"));
    EXPECT_THAT(names_in(folder / "store"), ElementsAre("b.ele", "b.node", "other.edge"));
    EXPECT_EQ(read_mesh(folder / "a.ele"), mesh);
    EXPECT_EQ(read_mesh(folder / "store/b.ele"), mesh);
}

TEST(OutputLinks, OfListsThatTheMeshHasStay) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    for (const std::string extension : {".node", ".ele", ".face"}) {
        fs::create_symlink("store/b" + extension, folder / ("a" + extension));
    }
    const Mesh mesh = mesh_with_facets();
    for (int time = 0; time < 2; ++time) (void)write_mesh(mesh, folder / "a.ele");
    EXPECT_THAT(names_in(folder / "store"), ElementsAre("b.ele", "b.face", "b.node"));
    EXPECT_EQ(read_mesh(folder / "store/b.ele"), mesh);
}

TEST(OutputPermissions, OfFilesThatAreThereStayAndThoseOfNewOnesAreTheUsual) {
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    for (const unsigned mode : {0600U, 0640U, 0666U, 0751U}) {
        for (const std::string name : {"a.node", "a.ele", "a.mesh", "a.vtu", "text"}) {
            test::write_file(folder / name, "as it was");
            ASSERT_EQ(::chmod((folder / name).c_str(), mode), 0);
        }
        for (const std::string output : {"a.ele", "a.mesh", "a.vtu"}) {
            (void)write_mesh(mesh_with_facets(), folder / output);
        }
        write_text("text", folder / "text");
        for (const std::string name : {"a.node", "a.ele", "a.mesh", "a.vtu", "text"}) {
            EXPECT_NE(content_of(folder / name), "as it was");
            EXPECT_EQ(mode_of(folder / name), mode) << name;
        }
        EXPECT_EQ(mode_of(folder / "a.face"), 0640U) << "a new file";
    }
    ::umask(before);
}

TEST(OutputPermissions, GoWithOwnerAndGroupWhereTheSystemAllowsIt) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root gives files to others";
    const TemporaryFolder folder;
    write_text("as it was", folder / "text");
    ASSERT_EQ(::chown((folder / "text").c_str(), 1234, 2345), 0);
    ASSERT_EQ(::chmod((folder / "text").c_str(), 0640), 0);
    write_text("new", folder / "text");
    struct stat status {};
    ASSERT_EQ(::stat((folder / "text").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 1234U);
    EXPECT_EQ(status.st_gid, 2345U);
    EXPECT_EQ(mode_of(folder / "text"), 0640U);
}

/// If the file's group is only the writer's own group, it gets no permissions.
TEST(OutputPermissions, OfAGroupThatCannotBeKeptAreRemoved) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root gives files to others";
    const TemporaryFolder folder;
    write_text("as it was", folder / "text");
    ASSERT_EQ(::chown((folder / "text").c_str(), nobody, 2345), 0);
    ASSERT_EQ(::chmod((folder / "text").c_str(), 0660), 0);
    EXPECT_EQ(as_nobody(folder, [&] { write_text("new", folder / "text"); }), "");
    EXPECT_EQ(content_of(folder / "text"), "new");
    EXPECT_EQ(mode_of(folder / "text"), 0600U);
}

TEST(OutputPermissions, ThatForbidWritingAreHeeded) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.mesh", "b.face", "text"}) {
        test::write_file(folder / name, "as it was");
        fs::permissions(folder / name, fs::perms::owner_read);
    }
    fs::create_symlink("a.mesh", folder / "link.mesh");
    const Mesh mesh = test::kuhn(1, 1, 1);
    const std::string reason = ": is not writable; change its permissions or choose another name";
    const auto refusal = [&](const std::string& output) {
        return as_nobody(folder, [&] { (void)write_mesh(mesh, folder / output); });
    };
    EXPECT_EQ(refusal("a.mesh"), (folder / "a.mesh").native() + reason);
    EXPECT_EQ(refusal("link.mesh"), (folder / "link.mesh").native() + reason);
    EXPECT_EQ(refusal("b.ele"), (folder / "b.face").native() + reason);
    EXPECT_EQ(as_nobody(folder, [&] { write_text("new", folder / "text"); }),
              (folder / "text").native() + reason);
    EXPECT_EQ(content_of(folder / "a.mesh"), "as it was");
    EXPECT_THAT(names_in(folder.path()), ElementsAre("a.mesh", "b.face", "link.mesh", "text"));
}

TEST(OutputPermissions, OfTheFolderALinkLeadsToCount) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "store");
    fs::permissions(folder / "store", fs::perms::owner_read | fs::perms::owner_exec |
                                          fs::perms::others_read | fs::perms::others_exec);
    fs::create_symlink("store/a.mesh", folder / "a.mesh");
    EXPECT_THAT(
        as_nobody(folder, [&] { (void)write_mesh(test::kuhn(1, 1, 1), folder / "a.mesh"); }),
        HasSubstr("store is not writable"));
}

TEST(OutputHardLinks, AreParted) {
    const TemporaryFolder folder;
    test::write_file(folder / "a", "as it was");
    fs::create_hard_link(folder / "a", folder / "b");
    write_text("new", folder / "b");
    EXPECT_EQ(content_of(folder / "a"), "as it was");
    EXPECT_EQ(content_of(folder / "b"), "new");
}

}  // namespace
}  // namespace octetra
