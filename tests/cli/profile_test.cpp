#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/octetra_program.hpp"

/// `octetra refine --profile --trace`: the contents of the files, and the printed table.
namespace octetra {
namespace {

using Json = nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

/// Checks {min, mean, max, of_rank} for this number of ranks, and `sum` for additive figures.
void expect_spread(const Json& figure, std::size_t ranks, bool has_sum) {
    const auto of_rank = figure.at("of_rank").get<std::vector<double>>();
    ASSERT_EQ(of_rank.size(), ranks);
    double sum = 0;
    for (const double value : of_rank) {
        EXPECT_GE(value, 0);
        sum += value;
    }
    EXPECT_EQ(figure.at("min").get<double>(), *std::ranges::min_element(of_rank));
    EXPECT_EQ(figure.at("max").get<double>(), *std::ranges::max_element(of_rank));
    EXPECT_DOUBLE_EQ(figure.at("mean").get<double>(), sum / static_cast<double>(ranks));
    EXPECT_EQ(figure.contains("sum"), has_sum);
    if (has_sum) {
        EXPECT_EQ(figure.at("sum").get<double>(), sum);
    }
    EXPECT_EQ(figure.size(), has_sum ? 5U : 4U);
}

/// Checks the complete schema in cli/src/profile/format_profile.hpp.
void expect_schema(const Json& profile, std::size_t ranks) {
    EXPECT_EQ(profile.size(), 7U);
    EXPECT_EQ(profile.at("format"), "octetra profile");
    EXPECT_EQ(profile.at("version"), 1);
    EXPECT_EQ(profile.at("ranks"), ranks);
    expect_spread(profile.at("seconds"), ranks, false);
    expect_spread(profile.at("peak_memory_bytes"), ranks, false);
    EXPECT_GT(profile.at("peak_memory_bytes").at("min"), 1'000'000);
    for (const Json& level : profile.at("levels")) {
        EXPECT_EQ(level.size(), 4U);
        EXPECT_TRUE(level.at("level").is_number_integer());
        expect_spread(level.at("cells"), ranks, true);
        expect_spread(level.at("cells_touched"), ranks, true);
        expect_spread(level.at("peak_memory_bytes"), ranks, false);
    }
    std::vector<double> seconds(ranks);
    for (const Json& phase : profile.at("phases")) {
        EXPECT_EQ(phase.size(), 9U);
        EXPECT_TRUE(phase.at("phase").is_string());
        EXPECT_TRUE(phase.at("level").is_number_integer());
        for (const char* name : {"messages", "bytes", "collectives", "collective_bytes"}) {
            expect_spread(phase.at(name), ranks, true);
        }
        expect_spread(phase.at("rounds"), ranks, false);
        for (const char* name : {"computing_seconds", "communicating_seconds"}) {
            expect_spread(phase.at(name), ranks, false);
            for (std::size_t r = 0; r < ranks; ++r) {
                seconds[r] += phase.at(name).at("of_rank")[r].get<double>();
            }
        }
    }
    for (std::size_t r = 0; r < ranks; ++r) {
        EXPECT_NEAR(seconds[r], profile.at("seconds").at("of_rank")[r].get<double>(), 1e-9);
    }
}

/// Checks that each rank has one named lane, in which spans are nested or disjoint.
void expect_trace(const Json& trace, std::size_t ranks) {
    struct Span {
        std::int64_t begin;
        std::int64_t end;
        bool is_phase;
    };
    std::vector<std::vector<Span>> lanes(ranks);
    std::vector<std::string> names(ranks);
    for (const Json& event : trace.at("traceEvents")) {
        const auto rank = event.at("pid").get<std::size_t>();
        ASSERT_LT(rank, ranks);
        EXPECT_EQ(event.at("tid"), 0);
        if (event.at("ph") == "M") {
            if (event.at("name") == "process_name") names[rank] = event.at("args").at("name");
            continue;
        }
        EXPECT_EQ(event.at("ph"), "X");
        const auto nanoseconds = [&](const char* key) {
            return std::llround(event.at(key).get<double>() * 1000);
        };
        const auto begin = nanoseconds("ts");
        lanes[rank].push_back({begin, begin + nanoseconds("dur"), event.at("cat") == "phase"});
    }
    for (std::size_t r = 0; r < ranks; ++r) {
        EXPECT_EQ(names[r], "rank " + std::to_string(r));
        EXPECT_GE(lanes[r].size(), 3U);
        std::vector<Span> around;
        for (const Span& span : lanes[r]) {
            while (!around.empty() && around.back().end <= span.begin) around.pop_back();
            if (around.empty()) {
                EXPECT_TRUE(span.is_phase) << "a communication of no phase";
            } else {
                EXPECT_GE(span.begin, around.back().begin);
                EXPECT_LE(span.end, around.back().end);
            }
            around.push_back(span);
        }
    }
}

class Profiled : public testing::Test {
protected:
    Profiled() {
        EXPECT_EQ(test::octetra("generate gear -o gear.1.ele --quiet", folder).status, 0);
    }
    [[nodiscard]] Json json(const std::string& name) const {
        return Json::parse(test::content_of(folder / name));
    }
    const TemporaryFolder folder;
    const std::string refine = "refine gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 -o p.mesh";
    const std::string measured = refine + " --profile p.json --trace t.json";
};

TEST_F(Profiled, RunsOfAnyNumberOfRanksReportTheirTimes) {
    ASSERT_EQ(test::octetra(refine, folder).status, 0);
    const std::string expected = test::content_of(folder / "p.mesh");
    for (const int ranks : {0, 1, 2, 3, 4}) {  // 0: without mpirun
        SCOPED_TRACE(ranks);
        const std::string command =
            measured + (ranks % 2 == 0 ? " --sync neighbour" : " --sync gateway");
        const auto run =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(test::content_of(folder / "p.mesh"), expected);
        const Json profile = json("p.json");
        const auto rank_count = static_cast<std::size_t>(std::max(ranks, 1));
        expect_schema(profile, rank_count);
        expect_trace(json("t.json"), rank_count);
        ASSERT_EQ(profile.at("levels").size(), 3U);
        EXPECT_EQ(profile.at("levels")[0].at("cells").at("sum"), 3103);
        EXPECT_EQ(profile.at("levels")[2].at("cells").at("sum"), 18246);
    }
}

TEST_F(Profiled, RefinementsOfAHistoryHaveTheirLevels) {
    const auto cells_of_levels = [&](const std::string& options, int ranks) {
        const auto run = test::octetra_on(ranks, options + " --profile p.json", folder);
        EXPECT_EQ(run.status, 0) << run.err;
        std::vector<std::pair<int, int>> cells;
        const Json profile = json("p.json");
        for (const Json& level : profile.at("levels")) {
            EXPECT_EQ(level.at("cells").at("of_rank").size(), static_cast<std::size_t>(ranks));
            cells.emplace_back(level.at("level"), level.at("cells").at("sum"));
        }
        return cells;
    };
    const std::string sphere = " --sphere 1,0,0.15,0.4 --levels 2 ";
    for (const int ranks : {1, 3}) {
        using testing::ElementsAre;
        using testing::Pair;
        const auto cells = cells_of_levels("refine gear.1.ele" + sphere + "-o p.mesh", ranks);
        EXPECT_THAT(cells, ElementsAre(Pair(0, 3103), Pair(1, testing::Gt(3103)), Pair(2, 18246)));
        EXPECT_EQ(cells_of_levels("refine gear.1.ele" + sphere + "-o p.octetra", ranks), cells);
        const auto more = cells_of_levels("refine p.octetra --all -o q.octetra", ranks);
        // The steps of its history are replayed.
        EXPECT_THAT(more, ElementsAre(cells[0], cells[1], cells[2], Pair(3, 8 * 18246)));
    }
}

/// The sphere is in one corner of the gear. A partition that balances the cells of the input would
/// leave nearly all cells of the result to one rank.
TEST_F(Profiled, RunsBalanceThePredictedCells) {
    for (const int ranks : {2, 4}) {
        for (const std::string method : {"lepp", "dual"}) {
            ASSERT_EQ(
                test::octetra_on(ranks,
                                 "refine gear.1.ele --sphere 1,0,0.15,0.2 --levels 4 -o p.ele "
                                 "--profile p.json --partition " +
                                     method,
                                 folder)
                    .status,
                0);
            const Json profile = json("p.json");
            const Json cells = profile.at("levels").back().at("cells");
            EXPECT_EQ(cells.at("sum"), 294'000);
            EXPECT_LT(cells.at("max").get<double>(), 1.3 * cells.at("mean").get<double>())
                << method << " on " << ranks;
        }
    }
}

TEST_F(Profiled, RunsAreDistributedLikeThePartitionCommand) {
    const std::string what = "gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 -n 3 -o parts.txt ";
    for (const std::string method : {"rcb", "lepp"}) {
        const auto said = test::octetra("partition " + what + "--partition " + method, folder);
        ASSERT_EQ(said.status, 0) << said.err;
        EXPECT_THAT(said.out, HasSubstr("\ncells expected after refinement "));
        std::vector<Json> cells;
        for (const std::string& partition : {method, std::string("file:parts.txt")}) {
            const auto run = test::octetra_on(3, measured + " --partition " + partition, folder);
            ASSERT_EQ(run.status, 0) << run.err;
            cells.push_back(json("p.json").at("levels").back().at("cells"));
        }
        EXPECT_EQ(cells[0], cells[1]) << method;
    }
    const auto unasked = test::octetra("partition gear.1.ele -n 3", folder);
    EXPECT_THAT(unasked.out, Not(HasSubstr("expected")));
}

/// All ranks together count the cells that are still too large, after the last level.
TEST_F(Profiled, RunsForAVolumeCommunicateWithinPhases) {
    ASSERT_EQ(test::octetra_on(3, measured + " --max-volume 1e-4", folder).status, 0);
    expect_schema(json("p.json"), 3);
    expect_trace(json("t.json"), 3);
}

TEST_F(Profiled, RunsOfTheReferenceReadRefineAndWrite) {
    for (const int ranks : {0, 2}) {
        const std::string command = measured + " --engine reference";
        const auto run =
            ranks == 0 ? test::octetra(command, folder) : test::octetra_on(ranks, command, folder);
        ASSERT_EQ(run.status, 0) << run.err;
        const Json profile = json("p.json");
        expect_schema(profile, static_cast<std::size_t>(std::max(ranks, 1)));
        std::vector<std::string> phases;
        for (const Json& phase : profile.at("phases")) phases.push_back(phase.at("phase"));
        EXPECT_THAT(phases, testing::ElementsAre("rest", "read", "refine", "write"));
    }
}

TEST_F(Profiled, RunsPrintATableOnceUnlessQuietAndOnlyWithProfile) {
    const auto run = test::octetra_on(3, measured, folder);
    EXPECT_EQ(test::occurrences(run.out, "\n3 ranks   "), 1U) << run.out;
    for (const std::string line :
         {"bisect tetrahedra", "closure", "total", "peak memory of a rank"}) {
        EXPECT_EQ(test::occurrences(run.out, "\n" + line), 1U) << run.out;
    }
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
    EXPECT_EQ(test::octetra_on(3, measured + " --quiet", folder).out, "");
    EXPECT_THAT(test::octetra(refine + " --trace t.json", folder).out, Not(HasSubstr("total")));
}

TEST_F(Profiled, RunsRefuseFilesThatCannotBeWrittenBeforeTheyBegin) {
    for (const std::string where :
         {"--profile no/p.json", "--trace no/t.json", "--profile gear.1.ele", "--trace p.mesh",
          "--profile x --trace x", "--maps x --profile ./x", "--profile /dev/null"}) {
        const auto run = test::octetra_on(2, refine + " " + where, folder);
        EXPECT_EQ(run.status, 2) << where << run.err;
        EXPECT_EQ(test::occurrences(run.err, "octetra: "), 1U) << where << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "p.mesh")) << where;
    }
}

TEST_F(Profiled, RunsThatFailWriteNoProfile) {
    const auto run =
        test::octetra_on(2, "refine gear.1.ele --region 3 -o q.mesh --profile q.json", folder);
    EXPECT_EQ(run.status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "q.json"));
}

}  // namespace
}  // namespace octetra
