#include <chrono>
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"
#include "support/meshes.hpp"

/// The program under mpirun: identical files, a single message, a single exit status.
namespace octetra {
namespace {

using test::occurrences;
using test::octetra_on;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

class Parallel : public testing::Test {
protected:
    Parallel() {
        EXPECT_EQ(test::octetra("generate gear -o gear.1.ele --quiet", folder).status, 0);
    }
    void expect_same_files(const std::string& a, const std::string& b) const {
        for (const std::string extension : {"node", "ele", "face", "edge"}) {
            EXPECT_EQ(test::content_of(folder / (a + "." + extension)),
                      test::content_of(folder / (b + "." + extension)))
                << b << "." << extension;
        }
    }
    const TemporaryFolder folder;
    const std::string refine = "refine gear.1.ele --sphere 1,0,0.15,0.4 --levels 2 ";
};

TEST_F(Parallel, WritesTheSameBytesOnAnyNumberOfRanksAndByTheReference) {
    ASSERT_EQ(test::octetra(refine + "--engine reference -o r.ele --maps r.txt", folder).status, 0);
    ASSERT_EQ(test::octetra(refine + "-o d.ele --maps d.txt", folder).status, 0);
    expect_same_files("r", "d");
    EXPECT_EQ(test::content_of(folder / "r.txt"), test::content_of(folder / "d.txt"));
    ASSERT_EQ(test::octetra(refine + "-o r.mesh", folder).status, 0);
    ASSERT_EQ(test::octetra(refine + "-o r.vtu", folder).status, 0);
    const std::vector<std::string> ways{"", "--sync gateway --partition dual",
                                        "--partition random:7 --rebalance never",
                                        "--partition block --rebalance 0"};
    for (const int ranks : test::rank_counts({3, 1, 2, 4})) {
        for (const std::string& how : ways) {
            if (ranks < 3 && how != ways[static_cast<std::size_t>(ranks - 1)]) continue;
            const auto run = octetra_on(ranks, refine + how + " -o p.ele --maps p.txt", folder);
            ASSERT_EQ(run.status, 0) << run.err;
            expect_same_files("r", "p");
            EXPECT_EQ(test::content_of(folder / "r.txt"), test::content_of(folder / "p.txt"));
        }
    }
    for (const std::string extension : {"mesh", "vtu"}) {
        ASSERT_EQ(octetra_on(3, refine + " -o p." + extension, folder).status, 0);
        EXPECT_EQ(test::content_of(folder / ("r." + extension)),
                  test::content_of(folder / ("p." + extension)));
    }
}

TEST_F(Parallel, TakesThePartsThatPartitionWrote) {
    const auto parts = test::octetra("partition gear.1.ele -n 3 -o parts.txt", folder);
    ASSERT_EQ(parts.status, 0) << parts.err;
    EXPECT_THAT(parts.out, HasSubstr("cut faces"));
    ASSERT_EQ(test::octetra(refine + "-o r.ele", folder).status, 0);
    const auto run = octetra_on(3, refine + "--partition file:parts.txt -o p.ele", folder);
    ASSERT_EQ(run.status, 0) << run.err;
    expect_same_files("r", "p");
}

TEST_F(Parallel, PrintsTheOutputOfOneProcessOnce) {
    const auto run = octetra_on(3, refine + "-o p.ele", folder);
    EXPECT_EQ(occurrences(run.out, "read gear.1.ele"), 1U) << run.out;
    EXPECT_THAT(run.out, HasSubstr("refined, 2 levels, 3 ranks"));
    EXPECT_EQ(occurrences(octetra_on(2, "info gear.1.ele", folder).out, "Euler"), 1U);
    EXPECT_EQ(occurrences(octetra_on(2, "--help", folder).out, "Exit status"), 1U);
}

TEST_F(Parallel, EndsInOneMessageAndTheSameStatusOnAllRanks) {
    (void)folder.write("bad.ele", "1 4 0\n0 0 1 2\n");
    (void)folder.write("bad.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    (void)folder.write("parts.txt", "0\n0\n");
    const std::vector<std::pair<std::string, std::string>> failures{
        {"refine bad.ele --all -o p.ele", "octetra: bad.ele:2: a vertex number is missing"},
        {"refine gear.1.ele --region 3 -o p.ele", "octetra: --region: "},
        {"refine gear.1.ele --all --partition file:parts.txt -o p.ele",
         "octetra: parts.txt: 2 part numbers"},
        {"refine gear.1.ele --all --partition metis -o p.ele", "octetra: --partition takes"},
        {"refine gear.1.ele --all -o no/p.ele", "octetra: no/p.ele: "},
        {"refine gear.1.ele -o p.ele", "octetra: specify which cells"},
        {"refine gear.1.ele --nonsense -o p.ele", "octetra: "},
        {"refine gear.1.ele --all --levels 9 --max-cells 99999 -o p.ele",
         "octetra: gear.1.ele: level 2 would make 198592 cells, more than the 99999 allowed"},
        {"refine gear.1.ele --all --levels 9 --max-cells 99999 --engine reference -o p.ele",
         "octetra: gear.1.ele: level 2 would make 198592 cells, more than the 99999 allowed"},
    };
    const auto alone =
        test::octetra("refine gear.1.ele --all --partition file:parts.txt -o p.ele", folder);
    EXPECT_EQ(alone.status, 2) << "a part file that does not fit is wrong for one rank, too";
    EXPECT_THAT(alone.err, HasSubstr("octetra: parts.txt:"));
    for (const auto& [command, message] : failures) {
        const auto run = octetra_on(3, command, folder);
        EXPECT_EQ(run.status, 2) << command << "\n" << run.err;
        EXPECT_EQ(occurrences(run.err, message), 1U) << command << "\n" << run.err;
        EXPECT_EQ(occurrences(run.err, "octetra: "), 1U) << command << "\n" << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "p.ele"));
    }
}

TEST_F(Parallel, ReportsRoundingAsOneProcessDoes) {
    Mesh mesh = test::kuhn(2, 2, 2);
    for (Point& p : mesh.points) p = {p.x * 2 + 0x1p52, p.y, p.z};
    (void)write_mesh(mesh, folder / "far.ele");
    const std::string command = "refine far.ele --all --levels 3 -o p.ele";
    const auto serial = test::octetra(command + " --engine reference", folder);
    EXPECT_THAT(serial.err, HasSubstr("octetra: far.ele: cell "));
    const auto parallel = octetra_on(4, command, folder);
    EXPECT_EQ(parallel.status, 2);
    EXPECT_THAT(parallel.err, HasSubstr(serial.err));
}

/// No rank may write a file of more than 50 KiB. Whichever rank meets the limit, all end in the
/// same way.
TEST_F(Parallel, EndsInOneMessageWhereARankCannotWriteAndLeavesNothing) {
    for (const std::string output :
         {"p.ele", "p.mesh", "p.meshb", "p.vtu", "p.pvtu", "p.vtkhdf", "p.xdmf", "p.octetra"}) {
        const auto run =
            test::run_program({OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh", "3", "sh", "-c",
                               "ulimit -f 100; exec " + std::string(OCTETRA_PROGRAM) +
                                   " refine gear.1.ele --all --quiet -o " + output},
                              folder.path());
        if (run.err.find("MPI_Init") != std::string::npos) {
            GTEST_SKIP() << "this MPI (MPICH with UCX) cannot start where files are so limited";
        }
        EXPECT_EQ(run.status, 3) << output << "\n" << run.err;
        EXPECT_EQ(occurrences(run.err, "octetra: p"), 1U) << output << "\n" << run.err;
        EXPECT_THAT(run.err, HasSubstr("writing failed: File too large")) << output;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            EXPECT_THAT(entry.path().filename().native(), testing::StartsWith("gear.1."));
        }
    }
}

TEST_F(Parallel, NeedsNoLargeFilesOfItsOwn) {
    const auto run =
        test::run_program({OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh", "2", "sh", "-c",
                           "ulimit -f 500; exec " OCTETRA_PROGRAM " info gear.1.ele"},
                          folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, test::octetra("info gear.1.ele", folder).out);
}

/// A rank that runs out of memory ends all ranks, without agreement.
TEST_F(Parallel, EndsAtOnceWhereARankIsOutOfMemoryAndKeepsTheOutput) {
    const auto with_little_memory = [&](const std::string& arguments) {
        return test::run_program(
            {"env", "OCTETRA_SECONDS_TO_END=1", OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh", "2",
             "sh", "-c",
             "ulimit -v 500000; exec " + std::string(OCTETRA_PROGRAM) + " " + arguments},
            folder.path());
    };
    if (with_little_memory("--version").status != 0) {
        GTEST_SKIP() << "built to need much address space, as with the address sanitizer";
    }
    (void)folder.write("p.mesh", "as it was");
    const auto run = with_little_memory("refine gear.1.ele --all --levels 50 --quiet -o p.mesh");
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_THAT(run.err, testing::ContainsRegex("octetra: rank [01]: out of memory\n"));
    EXPECT_EQ(occurrences(run.err, "octetra: "), 1U) << run.err;
    EXPECT_EQ(test::content_of(folder / "p.mesh"), "as it was");
}

/// All ranks fail at the same moment, see tests/support/mpi_exhauster.cpp. The first three
/// reductions are made at startup, for the communicator and for the lock that selects the rank that
/// prints.
TEST_F(Parallel, EndsInOneMessageWhereAllRanksAreOutOfMemory) {
    const TemporaryFolder locks;
    for (const int at : {4, 5, 7, 7, 7, 7}) {
        const auto run = test::run_program(
            test::words("env OCTETRA_SECONDS_TO_END=1 " OCTETRA_SOURCE_DIR
                        "/tests/support/mpirun.sh 4 env TMPDIR=" +
                        locks.path().native() + " LD_PRELOAD=" OCTETRA_MPI_EXHAUSTER +
                        " OCTETRA_EXHAUST_AT=" + std::to_string(at) + " " + OCTETRA_PROGRAM + " " +
                        refine + "--quiet -o p.mesh"),
            folder.path());
        EXPECT_EQ(run.status, 3) << run.err;
        EXPECT_EQ(occurrences(run.err, "octetra: "), 1U) << run.err;
        EXPECT_THAT(run.err, testing::ContainsRegex("octetra: rank [0-3]: out of memory\n"));
        EXPECT_FALSE(std::filesystem::exists(folder / "p.mesh"));
        EXPECT_TRUE(std::filesystem::is_empty(locks.path())) << "a lock was left behind";
    }
}

/// Runs a refinement in which a rank kills itself at one of its MPI calls; see
/// tests/support/mpi_killer.cpp.
test::Outcome run_with_a_kill(int rank, int at, const std::string& arguments,
                              const TemporaryFolder& folder) {
    return test::run_program(
        test::words(
            std::string("env OCTETRA_SECONDS_TO_END=1 " OCTETRA_SOURCE_DIR
                        "/tests/support/mpirun.sh 3") +
            " env LD_PRELOAD=" OCTETRA_MPI_KILLER + " OCTETRA_KILL_RANK=" + std::to_string(rank) +
            " OCTETRA_KILL_AT=" + std::to_string(at) + " " + OCTETRA_PROGRAM + " " + arguments),
        folder.path());
}

int calls_of_mpi(int rank, const std::string& arguments, const TemporaryFolder& folder) {
    const auto run = run_with_a_kill(rank, 0, arguments, folder);
    EXPECT_EQ(run.status, 0) << run.err;
    const std::string before = "calls of MPI: ";
    const auto place = run.err.find(before);
    if (place == std::string::npos) return 0;
    return std::stoi(run.err.substr(place + before.size()));
}

/// Kills different ranks at early, middle and late calls. The existing `output` must stay.
void expect_ends_at_kills(const std::string& command, const std::string& output,
                          const TemporaryFolder& folder) {
    const int calls = calls_of_mpi(2, command, folder);
    ASSERT_GT(calls, 40) << "the calls are not caught";
    const std::string complete = test::content_of(folder / output);
    // At its last call a rank waits for the first rank to write, which may just be finished.
    for (const auto& [rank, at] : {std::pair{2, 1}, {0, calls / 3}, {2, calls / 2}, {2, calls}}) {
        SCOPED_TRACE(testing::Message() << "rank " << rank << ", call " << at << " of " << calls);
        (void)folder.write(output, "as it was");
        const auto start = std::chrono::steady_clock::now();
        const auto run = run_with_a_kill(rank, at, command, folder);
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
        EXPECT_TRUE(test::reports_signal(run.status, SIGKILL)) << run.status;
        EXPECT_THAT(run.out + run.err, HasSubstr("signal 9"));  // MPICH: to stdout
        const std::string content = test::content_of(folder / output);
        EXPECT_TRUE(content == "as it was" || (at == calls && content == complete));
    }
}

TEST_F(Parallel, EndsAtOnceWhereverARankIsKilledAndKeepsTheOutput) {
    expect_ends_at_kills(refine + "--quiet -o p.mesh", "p.mesh", folder);
}

TEST_F(Parallel, EndsAtOnceWhereverARankIsKilledAndKeepsTheCheckpoint) {
    ASSERT_EQ(test::octetra(refine + "--quiet -o state.octetra", folder).status, 0);
    expect_ends_at_kills("coarsen state.octetra --all --quiet -o p.octetra", "p.octetra", folder);
}

}  // namespace
}  // namespace octetra
