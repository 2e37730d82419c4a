#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"

namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Convert, ThereAndBackGivesTheSameBytes) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate gear -o gear.1.ele", folder).status, 0);
    ASSERT_EQ(test::octetra("convert gear.1.ele gear.mesh", folder).status, 0);
    ASSERT_EQ(test::octetra("convert gear.mesh back.ele", folder).status, 0);
    ASSERT_EQ(test::octetra("convert back.ele again.mesh", folder).status, 0);
    EXPECT_EQ(test::content_of(folder / "gear.mesh"), test::content_of(folder / "again.mesh"));
    Mesh back = read_mesh(folder / "back.ele");
    EXPECT_EQ(back.index_base, 1U) << "Medit counts from 1, and so does what came from it";
    back.index_base = 0;
    EXPECT_EQ(back, read_mesh(folder / "gear.1.ele"));
}

TEST(Convert, ToABinaryMeditFileAndBackGivesTheSameText) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate gear -o gear.mesh", folder).status, 0);
    ASSERT_EQ(test::octetra("convert gear.mesh gear.meshb", folder).status, 0);
    ASSERT_EQ(test::octetra("convert gear.meshb back.mesh", folder).status, 0);
    EXPECT_EQ(test::content_of(folder / "gear.mesh"), test::content_of(folder / "back.mesh"));
    EXPECT_EQ(test::octetra("compare gear.mesh gear.meshb", folder).status, 0);
}

TEST(Convert, ReportsDataThatTheFormatCannotStore) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 2 -o cube.ele", folder).status, 0);
    const test::Outcome run = test::octetra("convert cube.ele cube.vtu", folder);
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err, HasSubstr("octetra: note: the .vtu file holds cells only"));
}

TEST(Convert, WritesTheMshThatIsAskedFor) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 2 -o cube.mesh", folder).status, 0);
    for (const auto& [word, head] :
         std::vector<std::pair<std::string, std::string>>{{"4.1", "4.1 1 8\n"},
                                                          {"4.1-text", "4.1 0 8\n"},
                                                          {"2.2", "2.2 1 8\n"},
                                                          {"2.2-text", "2.2 0 8\n"}}) {
        ASSERT_EQ(test::octetra("convert cube.mesh a.msh --msh-format " + word, folder).status, 0);
        EXPECT_THAT(test::content_of(folder / "a.msh"), StartsWith("$MeshFormat\n" + head));
        ASSERT_EQ(test::octetra("convert a.msh back.mesh", folder).status, 0);
        EXPECT_EQ(test::content_of(folder / "back.mesh"), test::content_of(folder / "cube.mesh"));
    }
    ASSERT_EQ(test::octetra("convert cube.mesh b.msh", folder).status, 0);
    EXPECT_THAT(test::content_of(folder / "b.msh"), StartsWith("$MeshFormat\n4.1 1 8\n"));
    EXPECT_EQ(test::octetra("convert cube.mesh a.msh --msh-format 3", folder).err,
              "octetra: --msh-format takes one of 4.1, 4.1-text, 2.2, 2.2-text, not '3'\n");
    EXPECT_EQ(test::octetra("convert cube.mesh a.vtu --msh-format 2.2", folder).err,
              "octetra: --msh-format applies only to .msh files, not a.vtu\n");
}

TEST(Convert, ToAFullDiskEndsInStatus3) {
    const TemporaryFolder folder;
    ASSERT_EQ(test::octetra("generate kuhn 2 -o cube.ele", folder).status, 0);
    // The shell limits the size of files and ignores the signal, so that the program sees the
    // error.
    const auto run =
        test::run_program({"sh", "-c",
                           "trap '' XFSZ; ulimit -f 1; exec " + std::string(OCTETRA_PROGRAM) +
                               " refine cube.ele --all --levels 2 -o fine.mesh"},
                          folder.path());
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.err, HasSubstr("octetra: fine.mesh: writing failed"));
    EXPECT_FALSE(std::filesystem::exists(folder / "fine.mesh"));
}

}  // namespace
}  // namespace octetra
