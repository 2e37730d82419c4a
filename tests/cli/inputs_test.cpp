#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// What is read stays as it was: no output takes its place.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Inputs : public testing::Test {
protected:
    Inputs() {
        EXPECT_EQ(test::octetra("generate two-material -o m.1.ele", folder).status, 0);
        EXPECT_EQ(test::octetra("convert m.1.ele m.mesh", folder).status, 0);
        EXPECT_EQ(test::octetra("refine m.1.ele --all -o f.1.ele --maps maps.txt", folder).status,
                  0);
        EXPECT_EQ(test::octetra("partition m.1.ele -n 2 -o parts.txt", folder).status, 0);
        (void)folder.write("cells.txt", "1 2 3\n");
        // The same facets by another name, of a mesh that is otherwise other files.
        fs::create_symlink("m.1.face", folder / "link.1.face");
        fs::create_directory(folder / "sub");
    }

    /// The bytes of everything that is there.
    [[nodiscard]] std::map<std::string, std::string> content() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (!entry.is_directory())
                all[entry.path().filename()] = test::content_of(entry.path());
        }
        return all;
    }

    void expect_refused(const std::string& command, const std::string& message) const {
        const auto before = content();
        const test::Outcome run = test::octetra(command, folder);
        EXPECT_EQ(run.status, 2) << command;
        EXPECT_EQ(run.err, "octetra: " + message + "; choose another name\n") << command;
        EXPECT_TRUE(content() == before) << command;
    }

    const test::TemporaryFolder folder;
};

TEST_F(Inputs, AreNotReplacedByTheMeshThatIsWritten) {
    expect_refused("refine m.1.ele --all -o m.1.ele", "-o would write over m.1.node of MESH");
    expect_refused("refine m.1.ele --all -o m.1.node", "-o would write over m.1.node of MESH");
    expect_refused("refine m.mesh --all -o m.mesh", "-o would write over m.mesh of MESH");
    expect_refused("refine m.mesh --all -o sub/../m.mesh",
                   "-o would write over sub/../m.mesh, which is m.mesh, of MESH");
    expect_refused("refine m.1.ele --all -o link.1.ele",
                   "-o would write over link.1.face, which is m.1.face, of MESH");
    expect_refused("convert m.mesh m.mesh --fix-orientation",
                   "OUT would write over m.mesh of MESH");
    expect_refused("convert m.1.ele m.1.node", "OUT would write over m.1.node of MESH");
}

TEST_F(Inputs, AreNotReplacedByFilesBesideTheMesh) {
    const std::string refine = "refine m.1.ele -o g.1.ele ";
    expect_refused(refine + "--cells cells.txt --maps ./cells.txt",
                   "--maps would write over ./cells.txt, which is cells.txt, of --cells");
    expect_refused(refine + "--all --partition file:parts.txt --profile parts.txt",
                   "--profile would write over parts.txt of --partition");
    expect_refused(refine + "--cells cells.txt --trace cells.txt",
                   "--trace would write over cells.txt of --cells");
    expect_refused("partition m.1.ele -n 2 --partition file:parts.txt -o parts.txt",
                   "-o would write over parts.txt of --partition");
    expect_refused("verify m.1.ele f.1.ele --maps maps.txt --report maps.txt",
                   "--report would write over maps.txt of --maps");
    expect_refused("verify m.1.ele f.1.ele --cells cells.txt --report cells.txt",
                   "--report would write over cells.txt of --cells");
}

TEST_F(Inputs, LeaveOtherNamesFree) {
    EXPECT_EQ(test::octetra("refine m.1.ele --all -o sub/m.1.ele", folder).status, 0);
    EXPECT_EQ(test::octetra("refine m.1.ele --all -o sub/m.1.ele", folder).status, 0)
        << "over what an earlier run has written";
    EXPECT_EQ(test::octetra("convert m.1.ele m.1.mesh", folder).status, 0);
    EXPECT_EQ(test::octetra("convert m.1.ele m.1.vtu", folder).status, 0);
}

}  // namespace
}  // namespace octetra
