#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"

/// octetra adapt: the steps of a script equal the subcommands of the same names, on any number of
/// ranks.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class Adapt : public testing::Test {
protected:
    Adapt() {
        EXPECT_EQ(test::octetra("generate kuhn 4 -o kuhn.mesh --quiet", folder).status, 0);
        EXPECT_EQ(test::octetra("generate two-material -o m.ele --quiet", folder).status, 0);
    }

    [[nodiscard]] test::Outcome adapt(const std::string& mesh, const std::string& script,
                                      const std::string& options) const {
        (void)folder.write("s.txt", script);
        return test::octetra("adapt " + mesh + " --script s.txt --quiet " + options, folder);
    }
    void expect_done(const test::Outcome& run) const { EXPECT_EQ(run.status, 0) << run.err; }
    void run(const std::string& arguments) const {
        expect_done(test::octetra(arguments + " --quiet", folder));
    }
    void expect_same(const std::string& a, const std::string& b) const {
        EXPECT_TRUE(test::content_of(folder / a) == test::content_of(folder / b)) << a << " " << b;
    }

    const TemporaryFolder folder;
};

struct History {
    std::string script;
    std::vector<std::string> counts;  ///< the counts that the report prints after each step
};

std::string counted(const std::string& vertices, const std::string& cells) {
    return std::string(14 - vertices.size(), ' ') + vertices + " vertices " +
           std::string(13 - cells.size(), ' ') + cells + " cells";
}

/// Counts computed by an independent program.
const std::vector<History> histories{
    {"refine --sphere .3,.4,.5,.3\n"
     "refine --sphere .3,.4,.5,.2\n"
     "coarsen --sphere .3,.4,.5,.2\n"
     "refine --sphere .7,.6,.5,.25\n"
     "coarsen --sphere .3,.4,.5,.4\n"
     "coarsen --all\n"
     "coarsen --all\n"
     "coarsen --all\n",
     {counted("290", "1,254"), counted("679", "3,420"), counted("636", "3,128"),
      counted("1,162", "6,108"), counted("701", "3,500"), counted("287", "1,250"),
      counted("190", "734"), counted("125", "384")}},
    {"refine --all\n"
     "refine --sphere .5,.5,.5,.3\n"
     "coarsen --all\n"
     "coarsen --all\n",
     {counted("729", "3,072"), counted("1,381", "6,768"), counted("385", "1,872"),
      counted("125", "384")}},
};

TEST_F(Adapt, HasTheCountsThatWereFoundIndependently) {
    for (const auto& [script, counts] : histories) {
        (void)folder.write("s.txt", script);
        const auto run = test::octetra("adapt kuhn.mesh --script s.txt -o out.mesh", folder);
        ASSERT_EQ(run.status, 0) << run.err;
        std::istringstream lines(run.out);
        std::string line;
        std::getline(lines, line);  // the line "read"
        for (const std::string& count : counts) {
            std::getline(lines, line);
            EXPECT_THAT(line, HasSubstr(count));
        }
        expect_same("out.mesh", "kuhn.mesh");
    }
}

TEST_F(Adapt, RefinesAsTheSubcommandDoes) {
    (void)folder.write("cells.txt", "0 7 4000");
    for (const std::string options :
         {"--all", "--sphere 0,0,0,0.4 --levels 3", "--random 0.1 --seed 3 --levels 2",
          "--cells cells.txt --levels 3", "--cells cells.txt --region 2 --levels 2 --scheme 4t",
          "--max-volume 1e-4 --levels 5 --scheme 2t", "--box 0,0,0,1,1,1 --levels 0"}) {
        run("refine m.ele -o by-refine.ele " + options);
        expect_done(adapt("m.ele", "refine " + options + "\n", "-o by-adapt.ele"));
        for (const std::string file : {"node", "ele", "face", "edge"}) {
            expect_same("by-adapt." + file, "by-refine." + file);
        }
    }
}

/// If all steps refine, each may also be run separately on the file written by the previous one.
TEST_F(Adapt, RefinesOnAsIfTheMeshHadBeenWrittenAndReadAgain) {
    (void)folder.write("cells.txt", "1 2 700 5001");
    run("refine m.ele -o one.ele --sphere 0,0,0,0.4");
    run("refine one.ele -o two.ele --cells cells.txt --levels 2");
    run("refine two.ele -o three.ele --cells cells.txt --random 0.05 --scheme 2t");
    const std::string script =
        "refine --sphere 0,0,0,0.4\nwrite mid.ele\nrefine --cells cells.txt --levels 2\n"
        "refine --cells cells.txt --random 0.05 --scheme 2t\n";
    (void)folder.write("s.txt", script);
    for (const int ranks : {1, 3}) {
        expect_done(
            test::octetra_on(ranks, "adapt m.ele --script s.txt --quiet -o end.ele", folder));
        for (const std::string file : {"node", "ele", "face"}) {
            expect_same("mid." + file, "one." + file);
            expect_same("end." + file, "three." + file);
        }
    }
}

TEST_F(Adapt, CoarsensListedCellsAndThoseOutside) {
    const std::string refine = "refine --sphere 0,0,0,0.4\n";
    expect_done(adapt("kuhn.mesh", refine, "-o fine.mesh"));
    const std::size_t count = read_mesh(folder / "fine.mesh").cells.size();
    std::string low;
    std::string high;
    for (std::size_t c = 1; c <= count; ++c)
        (c < count / 2 ? low : high) += std::to_string(c) + "\n";
    (void)folder.write("low.txt", low);
    (void)folder.write("high.txt", high);
    // For each criterion, cells inside one region are those outside its complement.
    const std::vector<std::pair<std::string, std::string>> alike{
        {"coarsen --box 0,0,0,1,1,0.15", "coarsen --outside --box 0,0,0.1500000001,1,1,1"},
        {"coarsen --cells low.txt", "coarsen --outside --cells high.txt"},
        {"coarsen --all --levels 50", "coarsen --outside --sphere 9,9,9,1"},
        {"coarsen --outside --all", "coarsen --sphere 9,9,9,1"},
    };
    std::set<std::string> results;
    for (const auto& [one, other] : alike) {
        SCOPED_TRACE(one);
        expect_done(adapt("kuhn.mesh", refine + one + "\n", "-o one.mesh"));
        expect_done(adapt("kuhn.mesh", refine + other + "\n", "-o other.mesh"));
        expect_same("one.mesh", "other.mesh");
        results.insert(test::content_of(folder / "one.mesh"));
    }
    EXPECT_EQ(results.size(), alike.size()) << "some are no coarsening";
}

TEST_F(Adapt, WritesTheSameBytesOnAnyNumberOfRanks) {
    (void)folder.write("cells.txt", "1 2 3 900 1500");
    (void)folder.write("s.txt",
                       "refine --sphere 0,0,0,0.4 --levels 2\n"
                       "refine --cells cells.txt --region 2\n"
                       "coarsen --outside --sphere 0.1,0,0,0.3 --levels 2\n"
                       "write mid.vtu\n"
                       "refine --random 0.05\n"
                       "coarsen --cells cells.txt --box 0,0,0,1,1,1\n");
    run("adapt m.ele --script s.txt -o alone.ele");
    const std::string mid = test::content_of(folder / "mid.vtu");
    for (const int ranks : test::rank_counts({3, 1, 2, 4, 7})) {
        for (const std::string how : {"--rebalance 0", "--sync gateway --partition dual",
                                      "--partition random:7 --rebalance never"}) {
            SCOPED_TRACE(testing::Message() << ranks << " ranks " << how);
            std::filesystem::remove(folder / "mid.vtu");
            expect_done(test::octetra_on(
                ranks, "adapt m.ele --script s.txt --quiet -o p.ele " + how, folder));
            for (const std::string file : {"node", "ele", "face"}) {
                expect_same("p." + file, "alone." + file);
            }
            EXPECT_TRUE(test::content_of(folder / "mid.vtu") == mid);
        }
    }
}

/// Steps that approach a corner, which few cells of the input contain.
std::string to_the_corner(int steps) {
    std::string script;
    double radius = 0.9;
    for (int k = 0; k < steps; ++k, radius *= 0.6) {
        script += "refine --sphere 0,0,0," + std::to_string(radius) + "\n";
    }
    return script;
}

TEST_F(Adapt, MakesRanksEvenWhereOneCornerHasMostOfTheCells) {
    run("generate kuhn 2 -o coarse.mesh");
    const std::string corner = to_the_corner(16) + "rebalance\n";
    const std::vector<std::array<std::string, 2>> cases{
        {corner, "mesh"}, {corner + "coarsen --sphere 0,0,0,0.01\n", "octetra"}};
    for (const auto& [script, format] : cases) {
        (void)folder.write("s.txt", script);
        const std::string by_script = "adapt coarse.mesh --script s.txt --rebalance 0.1 -o ";
        expect_done(test::octetra(by_script + "alone." + format, folder));
        const auto four = test::octetra_on(4, by_script + "four." + format, folder);
        expect_done(four);
        expect_same("alone." + format, "four." + format);
        const std::string before = "most/mean cells ";
        const auto at = four.out.find(before);
        ASSERT_NE(at, std::string::npos) << four.out;
        const std::string line = four.out.substr(at, four.out.find(" vertices", at) - at);
        const auto to = line.find(" to ");
        const auto begin = to == std::string::npos ? before.size() : to + 4;
        EXPECT_LE(std::stod(line.substr(begin)), 1.15) << line;
    }
}

/// Ranks are balanced all the same, except with --series, which writes the history at each step.
TEST_F(Adapt, RecallsTheHistoryForStepsAndFilesThatNeedIt) {
    run("generate kuhn 2 -o coarse.mesh");
    const std::string corner = to_the_corner(6);
    const std::vector<std::array<std::string, 2>> cases{
        {corner + "coarsen --all --levels 9\n", "-o OUT.mesh"},
        {corner + "write OUT.vtu\nrefine --sphere 0,0,0,0.03\ncoarsen --sphere 0,0,0,0.2\n" +
             "refine --sphere 0,0,0,0.02\n",
         "-o OUT.octetra"},
        {corner + "write OUT.octetra\n", "-o OUT.mesh"},
        {corner, "-o OUT.octetra"},
        {corner, "-o OUT.vtu"},
        {corner, "-o OUT.vtkhdf"},
        {corner + "write OUT.vtu\n", "-o OUT.mesh"},
        {corner, "-o OUT.mesh --series OUT.vtkhdf"},
        {corner, "-o OUT.mesh --verify"}};
    const auto named = [](std::string words, const std::string& name) {
        for (auto at = words.find("OUT"); at != std::string::npos; at = words.find("OUT")) {
            words.replace(at, 3, name);
        }
        return words;
    };
    for (const auto& [script, options] : cases) {
        (void)folder.write("a.txt", named(script, "alone"));
        (void)folder.write("f.txt", named(script, "four"));
        expect_done(
            test::octetra("adapt coarse.mesh --script a.txt " + named(options, "alone"), folder));
        expect_done(test::octetra_on(
            4, "adapt coarse.mesh --script f.txt --rebalance 0 " + named(options, "four"), folder));
        for (const std::string extension : {".mesh", ".octetra", ".vtu", ".vtkhdf"}) {
            if ((script + options).find(extension) == std::string::npos) continue;
            expect_same("alone" + extension, "four" + extension);
        }
    }
    const std::string refine = "refine coarse.mesh --box 0,0,0,.4,.4,.4 --levels 5 ";
    run(refine + "-o alone.vtu");
    expect_done(test::octetra_on(4, refine + "--rebalance 0 -o four.vtu", folder));
    expect_same("alone.vtu", "four.vtu");
    run(refine + "--maps alone.txt -o alone.mesh");
    for (const std::string more : {"--maps four.txt", "--verify", ""}) {
        expect_done(test::octetra_on(4, refine + "--rebalance 0 -o four.mesh " + more, folder));
        expect_same("alone.mesh", "four.mesh");
    }
    expect_same("alone.txt", "four.txt");
    (void)folder.write("cells.txt", "1\n2\n");
    const std::string listed = "refine coarse.mesh --cells cells.txt --levels 5 ";
    run(listed + "-o alone.mesh");
    expect_done(test::octetra_on(4, listed + "--rebalance 0 -o four.mesh", folder));
    expect_same("alone.mesh", "four.mesh");
}

TEST_F(Adapt, WritesTheSameBytesByTheReference) {
    std::string list;
    for (int c = 5; c < 60; c += 3) list += std::to_string(c) + "\n";
    (void)folder.write("c.txt", list);
    const std::string script =
        "refine --sphere 0,0,0,0.6 --levels 2\n"
        "write between.ele\n"
        "coarsen --sphere 0,0,0,0.35 --levels 2\n"
        "refine --cells c.txt --levels 2 --scheme 4t\n"
        "rebalance\n"
        "coarsen --cells c.txt --outside\n"
        "coarsen --box 0,0,0,0.5,0.5,0.5\n"
        "refine --random 0.05\n";
    for (const std::string mesh : {"kuhn.mesh", "m.ele"}) {
        expect_done(adapt(mesh, script, "-o d.mesh"));
        const std::string between = test::content_of(folder / "between.ele");
        expect_done(adapt(mesh, script, "--engine reference -o r.mesh"));
        expect_same("d.mesh", "r.mesh");
        EXPECT_TRUE(test::content_of(folder / "between.ele") == between);
    }
}

TEST_F(Adapt, WritesParentsAndTheSameReportByTheReference) {
    const auto run_by = [&](const std::string& engine, const std::string& name) {
        const auto run = test::octetra("adapt m.ele --script s.txt -o " + name + engine, folder);
        expect_done(run);
        std::set<std::string> all{std::regex_replace(run.out, std::regex(" +[0-9.]+ s"), ""),
                                  run.err};
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            const std::string file = entry.path().filename();
            if (file.front() == 'f') all.insert(file + test::content_of(entry.path()));
        }
        return all;
    };
    for (const std::string extension : {".vtu", ".pvtu", ".vtkhdf", ".xdmf", ".msh"}) {
        const std::string coarsen = "coarsen --sphere 0,0,0,0.35\n";
        (void)folder.write("s.txt", "refine --sphere 0,0,0,0.6 --levels 2\nwrite first" +
                                        extension + "\n" + coarsen +
                                        "rebalance\nrefine --random 0.05\n");
        const auto expected = run_by("", "f" + extension);
        EXPECT_GE(expected.size(), 4U);
        EXPECT_TRUE(run_by(" --engine reference", "f" + extension) == expected) << extension;
    }
}

TEST_F(Adapt, RefusesOptionsThatTheReferenceDoesNotSupport) {
    const std::string refine = "refine --all\n";
    run("convert kuhn.mesh kuhn.octetra");
    for (const auto& [mesh, script, options, words] : std::vector<std::array<std::string, 4>>{
             {"kuhn.octetra", refine, "-o r.mesh", "records no history"},
             {"kuhn.mesh", refine, "-o r.octetra", "records no history"},
             {"kuhn.mesh", refine + "save r.octetra\n", "-o r.mesh", "s.txt:2: --engine reference"},
             {"kuhn.mesh", refine, "-o r.mesh --verify",
              "cannot be combined with --engine reference"},
             {"kuhn.mesh", refine, "-o r.mesh --partition rcb",
              "--engine reference, which uses one"},
             {"kuhn.mesh", "refine --region 3\n", "-o r.mesh", "s.txt:1: --region"},
             {"kuhn.mesh", refine, "-o r.mesh --max-cells 9", "s.txt:1: level 1 would"},
             {"kuhn.mesh", refine + "refine --all --levels 2", "-o r.mesh --max-cells 30000",
              "s.txt:2: level 3 would make 196608 cells, more than the 30000 allowed: mark fewer "
              "cells or levels, or allow more (levels count all steps that have made this mesh; "
              "this is level 2 of 2 here)"}}) {
        const auto run = adapt(mesh, script, "--engine reference " + options);
        EXPECT_EQ(run.status, 2);
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_FALSE(std::filesystem::exists(folder / "r.mesh"));
    }
}

TEST_F(Adapt, WritesOverNothingThatItReadsByEitherEngine) {
    for (const std::string engine : {"distributed", "reference"}) {
        (void)folder.write("list.mesh", "3\n");
        const auto run = adapt("kuhn.mesh", "refine --cells list.mesh\nwrite list.mesh\n",
                               "-o r.mesh --engine " + engine);
        EXPECT_EQ(run.status, 2) << engine;
        EXPECT_EQ(test::content_of(folder / "list.mesh"), "3\n") << engine;
    }
}

TEST_F(Adapt, EndsInOneMessageOnSeveralRanks) {
    const std::vector<std::pair<std::string, std::string>> failures{
        {"refien --all\n", "octetra: s.txt:1: a step begins with one of"},
        {"refine --all\nrefine --region 3 --levels 9\nwrite no/x.vtu\n",
         "octetra: s.txt:3: no/x.vtu: there is no directory"},
        {"refine --all\nrefine --all --levels 9\n", "octetra: s.txt:2: level 2 would make "},
        {"refine --cells cells.txt\n", "octetra: s.txt:1: cells.txt:1: there is no cell 99999"},
    };
    (void)folder.write("cells.txt", "99999");
    for (const auto& [script, message] : failures) {
        (void)folder.write("s.txt", script);
        const auto run = test::octetra_on(
            3, "adapt m.ele --script s.txt --quiet --max-cells 100000 -o p.ele", folder);
        EXPECT_EQ(run.status, 2) << script << run.err;
        EXPECT_EQ(test::occurrences(run.err, message), 1U) << script << run.err;
        EXPECT_EQ(test::occurrences(run.err, "octetra: "), 1U) << script << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "p.ele"));
    }
}

TEST_F(Adapt, VerifiesTheResultAndWritesOnlyWhatIsValid) {
    const std::string steps =
        "refine --sphere 0,0,0,0.4 --levels 2\ncoarsen --outside --sphere 0,0,0,0.2\n";
    (void)folder.write("s.txt", steps);
    // Three cells at one face can be read and refined, but are not a valid mesh.
    (void)folder.write("three.node",
                       "6 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 -1\n5 2 2 1\n");
    (void)folder.write("three.ele", "3 4 0\n0 0 1 2 3\n1 0 2 1 4\n2 0 1 2 5\n");
    run("adapt m.ele --script s.txt -o unjudged.ele");
    for (const int ranks : {1, 2}) {
        (void)folder.write("s.txt", steps);
        const auto good =
            test::octetra_on(ranks, "adapt m.ele --script s.txt -o good.ele --verify", folder);
        expect_done(good);
        EXPECT_THAT(good.err, HasSubstr("note: of m.ele itself, only orientation and"));
        expect_same("good.ele", "unjudged.ele");
        (void)folder.write("s.txt", "refine --all\n");
        const auto bad =
            test::octetra_on(ranks, "adapt three.ele --script s.txt -o bad.ele --verify", folder);
        EXPECT_EQ(bad.status, 1) << bad.err;
        EXPECT_THAT(bad.out, HasSubstr("face_of_many_cells: 1"));
        EXPECT_THAT(bad.out, HasSubstr("bad.ele was not written"));
        EXPECT_FALSE(std::filesystem::exists(folder / "bad.ele"));
    }
}

TEST_F(Adapt, IsProfiled) {
    (void)folder.write("s.txt", "refine --all\ncoarsen --all\n");
    const auto run = test::octetra_on(
        2, "adapt m.ele --script s.txt -o out.ele --profile p.json --trace t.json", folder);
    expect_done(run);
    EXPECT_THAT(run.out, HasSubstr("bisect tetrahedra"));
    EXPECT_THAT(test::content_of(folder / "p.json"), HasSubstr("number vertices"));
    EXPECT_THAT(test::content_of(folder / "t.json"), HasSubstr("closure"));
}

}  // namespace
}  // namespace octetra
