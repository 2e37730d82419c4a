#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// Meshes with their history, .octetra, on the command line.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class Checkpoints : public testing::Test {
protected:
    Checkpoints() { run("generate two-material -o m.ele"); }

    void run(const std::string& arguments, int ranks = 0) const {
        const std::string command = arguments + " --quiet";
        const auto outcome =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    }
    void expect_same(const std::string& a, const std::string& b) const {
        EXPECT_TRUE(test::content_of(folder / a) == test::content_of(folder / b)) << a << " " << b;
    }
    void expect_refused(const std::string& arguments, const std::string& message) const {
        const auto outcome = test::octetra(arguments, folder);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_EQ(outcome.err, "octetra: " + message + "\n");
        EXPECT_EQ(outcome.out, "");
    }

    const TemporaryFolder folder;
};

/// Single steps from file to file, and one script with all of them, on any number of ranks.
TEST_F(Checkpoints, OfSingleStepsAreThoseOfAScript) {
    (void)folder.write("cells.txt", "0 7 3000");
    const std::vector<std::string> steps{"refine --sphere 0,0,0,0.4 --levels 2",
                                         "coarsen --outside --sphere 0.1,0,0,0.3",
                                         "refine --cells cells.txt --region 2 --scheme 4t",
                                         "coarsen --cells cells.txt", "coarsen --all --levels 2"};
    std::string script;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        script += steps[i] + "\nsave step" + std::to_string(i) + ".octetra\n";
    }
    (void)folder.write("s.txt", script);
    run("adapt m.ele --script s.txt -o end.ele");
    for (const int ranks : test::rank_counts({3, 1, 2, 4, 7})) {
        SCOPED_TRACE(ranks);
        std::string before = "m.ele";
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const std::string after = "single" + std::to_string(i) + ".octetra";
            const auto blank = steps[i].find(' ');
            run(steps[i].substr(0, blank) + " " + before + steps[i].substr(blank) + " -o " + after,
                ranks);
            expect_same(after, "step" + std::to_string(i) + ".octetra");
            before = after;
        }
        run("coarsen single3.octetra --all --levels 2 -o last.ele", ranks);
        for (const std::string file : {"node", "ele", "face"}) {
            expect_same("last." + file, "end." + file);
        }
    }
}

TEST_F(Checkpoints, AreReadAndWrittenByOtherSubcommands) {
    run("refine m.ele --sphere 0,0,0,0.4 -o f.octetra");
    run("refine m.ele --sphere 0,0,0,0.4 -o f.ele");
    run("convert f.octetra back.ele");
    for (const std::string file : {"node", "ele", "face"}) expect_same("back." + file, "f." + file);
    const std::string info = test::octetra("info f.ele", folder).out;
    EXPECT_THAT(test::octetra("info f.octetra", folder).out, testing::StartsWith(info));
    EXPECT_THAT(test::octetra("info f.octetra", folder).out.substr(info.size()),
                testing::ContainsRegex("Step +cells before +cells cut +cells after +bytes\n  1  "));
    EXPECT_THAT(test::octetra("info f.octetra --json", folder).out, HasSubstr("\"cells_cut\""));
    for (const int ranks : {1, 3}) {
        const auto on = [&](const std::string& command) {
            return test::octetra_on(ranks, command, folder).status;
        };
        EXPECT_EQ(on("compare f.octetra f.ele --identical"), 0);
        EXPECT_EQ(on("verify f.octetra"), 0);
        EXPECT_EQ(on("verify m.ele f.octetra --sphere 0,0,0,0.4"), 0);
        EXPECT_EQ(on("verify f.octetra m.ele"), 1);
    }
    EXPECT_EQ(test::octetra("partition f.octetra -n 3 -o a.txt", folder).status, 0);
    EXPECT_EQ(test::octetra("partition f.ele -n 3 -o b.txt", folder).status, 0);
    expect_same("a.txt", "b.txt");
    run("generate two-material -o m.octetra");
    run("convert m.ele copy.octetra");
    expect_same("copy.octetra", "m.octetra");
    run("refine m.octetra --sphere 0,0,0,0.4 -o again.octetra");
    expect_same("again.octetra", "f.octetra");
    run("coarsen f.octetra --all -o m2.octetra --verify");
    expect_same("m2.octetra", "m.octetra");
}

TEST_F(Checkpoints, KeepTheirHistoryWhenCopied) {
    run("refine m.ele --sphere 0,0,0,0.4 --levels 2 -o s.octetra");
    run("convert s.octetra copy.octetra");
    expect_same("s.octetra", "copy.octetra");
}

TEST_F(Checkpoints, AreWhatCoarseningTakesAndOthersAreRefused) {
    run("refine m.ele --all -o f.octetra");
    expect_refused("coarsen m.ele --all -o c.octetra",
                   "m.ele has no refinement history: coarsening requires a .octetra file, as "
                   "written by octetra refine or adapt with -o FILE.octetra");
    expect_refused("coarsen f.octetra -o c.octetra",
                   "specify which cells to coarsen: --all, --cells, --sphere, --box, --region, "
                   "--random or --max-volume");
    expect_refused("coarsen f.octetra --all -o f.octetra",
                   "-o would write over f.octetra of MESH; choose another name");
    for (const std::string files : {"m.ele -o g.octetra", "f.octetra -o g.ele"}) {
        expect_refused("refine --engine reference --all " + files,
                       "--engine reference does not support history and cannot be combined with "
                       ".octetra files: omit it; the default engine makes the same mesh");
    }
    (void)folder.write("bad.octetra", "no checkpoint");
    for (const std::string command :
         {"info bad.octetra", "coarsen bad.octetra --all -o c.ele", "convert bad.octetra c.ele"}) {
        const auto outcome = test::octetra(command, folder);
        EXPECT_EQ(outcome.status, 2) << command;
        EXPECT_THAT(outcome.err, HasSubstr("octetra: bad.octetra: ")) << command;
    }
}

}  // namespace
}  // namespace octetra
