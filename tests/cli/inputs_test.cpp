#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// Inputs are never overwritten by outputs.
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
        // Another name of the same facets, for a mesh whose other files differ.
        fs::create_symlink("m.1.face", folder / "link.1.face");
        fs::create_directory(folder / "sub");
    }

    /// The contents of all files of the folder.
    [[nodiscard]] std::map<std::string, std::string> content() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (entry.is_regular_file())
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

constexpr const char* byte_order_mark = "\xef\xbb\xbf";

/// All text inputs: meshes, lists, maps and parts.
TEST_F(Inputs, MayBeginWithAByteOrderMark) {
    EXPECT_EQ(test::octetra("convert f.1.ele f.mesh", folder).status, 0);
    const std::vector<std::string> commands{"info m.1.ele",
                                            "info m.mesh",
                                            "verify m.1.ele f.1.ele --maps maps.txt",
                                            "compare f.1.ele f.mesh",
                                            "refine m.1.ele --cells cells.txt -o g.mesh",
                                            "partition m.1.ele -n 2 --partition file:parts.txt"};
    std::vector<std::string> results;
    for (const std::string& command : commands) {
        results.push_back(test::octetra(command, folder).out);
        EXPECT_NE(results.back(), "") << command;
    }
    const std::string refined = test::content_of(folder / "g.mesh");
    for (const auto& [name, bytes] : content()) {
        if (name != "link.1.face") (void)folder.write(name, byte_order_mark + bytes);
    }
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const auto run = test::octetra(commands[i], folder);
        EXPECT_EQ(run.err, "") << commands[i];
        if (commands[i].starts_with("refine")) continue;  // which prints seconds
        EXPECT_EQ(run.out, results[i]) << commands[i];
    }
    EXPECT_EQ(test::content_of(folder / "g.mesh"), refined);
}

/// A byte order mark is accepted only once and only at the start; lines are counted as without it.
TEST_F(Inputs, HaveTheirLinesCountedAsWithoutAByteOrderMark) {
    const auto said = [&](const std::string& cells) {
        (void)folder.write("cells.txt", cells);
        return test::octetra("refine m.1.ele --cells cells.txt -o g.mesh", folder).err;
    };
    const std::string mark = byte_order_mark;
    EXPECT_EQ(said(mark + "1\n# two\nx\n"), said("1\n# two\nx\n"));
    EXPECT_EQ(said(mark + "x\n"), said("x\n"));
    EXPECT_THAT(said(mark + mark + "1\n"), HasSubstr("cells.txt:1: "));
    EXPECT_THAT(said("1\n" + mark + "2\n"), HasSubstr("cells.txt:2: "));
    (void)folder.write("only.node", mark);
    (void)folder.write("only.ele", mark);
    EXPECT_THAT(test::octetra("info only.ele", folder).err, HasSubstr("octetra: only.node:1: "));
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

/// Each link has the name of an output file.
TEST_F(Inputs, AreNotReplacedThroughLinks) {
    fs::create_symlink("../m.mesh", folder / "sub/chain");
    for (const std::string name : {"o.mesh", "o.face", "o_0.vtu", "o.json"}) {
        fs::create_symlink("sub/chain", folder / name);
    }
    const auto refusal = [](const std::string& argument, const std::string& name) {
        return argument + " would write over " + name + ", which is m.mesh, of MESH";
    };
    expect_refused("refine m.mesh --all -o o.mesh", refusal("-o", "o.mesh"));
    expect_refused("refine m.mesh --all -o o.ele", refusal("-o", "o.face"));
    expect_refused("refine m.mesh --all -o o.pvtu", refusal("-o", "o_0.vtu"));
    expect_refused("refine m.mesh --all -o p.ele --maps o.json", refusal("--maps", "o.json"));
    expect_refused("refine m.mesh --all -o p.ele --profile o.json", refusal("--profile", "o.json"));
    expect_refused("refine m.mesh --all -o p.ele --trace o.json", refusal("--trace", "o.json"));
    expect_refused("partition m.mesh -n 2 -o o.json", refusal("-o", "o.json"));
    expect_refused("verify m.mesh --report o.json", refusal("--report", "o.json"));
    expect_refused("convert m.mesh o.mesh", refusal("OUT", "o.mesh"));
    // The list beside the target of a link would be removed.
    fs::create_symlink("far.ele", folder / "near.ele");
    fs::create_symlink("m.mesh", folder / "far.face");
    expect_refused("refine m.mesh --all -o near.ele",
                   refusal("-o", (fs::canonical(folder.path()) / "far.face").native()));
}

TEST_F(Inputs, OfOneNameForTwoOutputsAreRefused) {
    fs::create_symlink("one.json", folder / "two.json");
    fs::create_symlink("out.1.face", folder / "three.json");
    const auto message = [&](const std::string& options) {
        const auto run = test::octetra("refine m.1.ele --all -o out.1.ele " + options, folder);
        EXPECT_EQ(run.status, 2) << options;
        EXPECT_FALSE(fs::exists(folder / "out.1.ele")) << options;
        return run.err;
    };
    EXPECT_EQ(message("--maps one.json --trace ./one.json"),
              "octetra: --maps and --trace name the same file, ./one.json, which is one.json\n");
    EXPECT_EQ(message("--profile one.json --trace two.json"),
              "octetra: --profile and --trace name the same file, two.json, which is one.json\n");
    EXPECT_EQ(message("--maps three.json"),
              "octetra: -o and --maps name the same file, three.json, which is out.1.face\n");
}

/// All outputs of the program, on one rank and on two.
TEST_F(Inputs, LeaveOutputsTheirLinksAndPermissions) {
    const std::vector<std::string> names{
        "o.node", "o.ele",  "o.face",  "o.mesh", "o.meshb", "o.vtkhdf", "o.xdmf", "o.h5",
        "o.vtu",  "o.pvtu", "o_0.vtu", "maps",   "profile", "trace",    "report", "parts"};
    for (const std::string& name : names) {
        (void)folder.write("sub/" + name, "as it was");
        fs::permissions(folder / ("sub/" + name), fs::perms::owner_read | fs::perms::owner_write);
        fs::create_symlink("sub/" + name, folder / name);
    }
    const std::string refine = "refine m.1.ele --all -o ";
    for (const int ranks : {1, 2}) {
        for (const std::string& name : names) (void)folder.write("sub/" + name, "as it was");
        for (const std::string& command :
             {refine + "o.ele --maps maps --profile profile --trace trace", refine + "o.mesh",
              refine + "o.meshb", refine + "o.vtkhdf", refine + "o.xdmf", refine + "o.vtu",
              refine + "o.pvtu", std::string("verify m.1.ele --report report"),
              std::string("partition m.1.ele -n 2 -o parts")}) {
            const auto run = ranks == 1 ? test::octetra(command, folder)
                                        : test::octetra_on(ranks, command, folder);
            EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
        }
        for (const std::string& name : names) {
            EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
            EXPECT_NE(test::content_of(folder / ("sub/" + name)), "as it was") << name;
            EXPECT_EQ(fs::status(folder / ("sub/" + name)).permissions(),
                      fs::perms::owner_read | fs::perms::owner_write)
                << name;
        }
    }
}

TEST_F(Inputs, LeaveOtherNamesFree) {
    auto expected = content();
    for (int run = 0; run < 2; ++run) {  // the second run replaces the files of the first
        EXPECT_EQ(test::octetra("refine m.1.ele --all -o sub/m.1.ele", folder).status, 0);
        for (const std::string extension : {"node", "ele", "face"}) {
            EXPECT_EQ(test::content_of(folder / "sub" / ("m.1." + extension)),
                      expected.at("f.1." + extension));
        }
        (void)folder.write("sub/m.1.ele", "the file of an earlier run");
    }
    EXPECT_EQ(test::octetra("convert m.1.ele m.1.mesh", folder).status, 0);
    EXPECT_EQ(test::octetra("convert m.1.ele m.1.vtu", folder).status, 0);
    expected["m.1.mesh"] = expected.at("m.mesh");
    auto present = content();
    EXPECT_EQ(present.erase("m.1.vtu"), 1U);
    EXPECT_EQ(present, expected);
}

}  // namespace
}  // namespace octetra
