#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/octetra_program.hpp"

/// The program with standard streams that are closed, full or without a reader: the work is
/// completed, the exit status is that of the work, or 3 if results could not be printed, and no
/// file receives the output of a stream.
namespace octetra {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::HasSubstr;

/// A command line and its outcome without faults.
struct Command {
    std::string arguments;
    int status;
    bool prints = false;    ///< results, on stdout
    std::string file = {};  ///< the file that it writes
};

/// A redirection by the shell, and whether it loses stdout.
struct Redirection {
    std::string text;
    bool loses_results = false;
};

class Streams : public testing::Test {
protected:
    Streams() {
        EXPECT_EQ(test::octetra("generate gear -o gear.ele --quiet", folder).status, 0);
        EXPECT_EQ(test::octetra("refine gear.ele --all -o fine.mesh --quiet", folder).status, 0);
        (void)folder.write("bad.mesh", "MeshVersionFormatted 2\nDimension 2\n");
    }

    /// Streams that are not redirected are captured.
    [[nodiscard]] test::Outcome run(const std::string& arguments,
                                    const std::string& redirection) const {
        return test::run_program({"/bin/bash", "-c", line(arguments, redirection)}, folder.path());
    }

    /// Redirects the streams of both ranks; those of mpirun stay as they are.
    [[nodiscard]] test::Outcome run_on_two(const std::string& arguments,
                                           const std::string& redirection) const {
        return test::run_program({OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh", "2", "/bin/bash",
                                  "-c", line(arguments, redirection)},
                                 folder.path());
    }

    /// Returns the contents of the written file, without its times, and removes it.
    [[nodiscard]] std::string take(const std::string& file) const {
        if (file.empty()) return {};
        const std::string content = test::content_of(folder / file);
        fs::remove(folder / file);
        return file.ends_with(".json") ? content.substr(0, content.find("seconds")) : content;
    }

    const TemporaryFolder folder;

private:
    static std::string line(const std::string& arguments, const std::string& redirection) {
        return "exec " OCTETRA_PROGRAM " " + arguments + " " + redirection;
    }
};

const std::vector<Redirection> redirections{
    {"<&-"},
    {"2>&-"},
    {"2>/dev/full"},
    {"<&- 2>&-"},
    {">&-", true},
    {">/dev/full", true},
    {">&- 2>&-", true},
    {"<&- >&- 2>&-", true},
    {">/dev/full 2>/dev/full", true},
};

TEST_F(Streams, ThatCannotBeUsedChangeNoFileAndNoStatusButWhereResultsAreLost) {
    const std::vector<Command> commands{
        {"refine gear.ele --all -o out.mesh", 0, true, "out.mesh"},
        {"refine gear.ele --all -o out.mesh --quiet", 0, false, "out.mesh"},
        {"refine gear.ele --sphere 9,9,9,1 -o out.mesh --quiet", 0, false, "out.mesh"},
        {"refine gear.ele --all -o f.ele --verify --profile out.json", 0, true, "out.json"},
        {"refine gear.ele --all -o no/out.mesh", 2},
        {"info gear.ele", 0, true},
        {"info gear.ele --json", 0, true},
        {"info nothing.ele", 2},
        {"generate kuhn 4 -o out.mesh", 0, true, "out.mesh"},
        {"generate gear -o out.mesh", 0, true, "out.mesh"},
        {"generate sphere --edge 0 -o out.mesh", 2},
        {"convert gear.ele out.mesh", 0, true, "out.mesh"},
        {"convert bad.mesh out.mesh", 2},
        {"partition gear.ele -n 2 -o out.txt", 0, true, "out.txt"},
        {"partition gear.ele -n 0", 2},
        {"verify gear.ele --report out.json", 0, true, "out.json"},
        {"verify fine.mesh gear.ele", 1, true},
        {"verify bad.mesh", 2},
        {"compare gear.ele gear.ele", 0, true},
        {"compare gear.ele fine.mesh", 1, true},
        {"compare gear.ele nothing.mesh", 2},
        {"--version", 0, true},
        {"refine --help", 0, true},
        {"nonsense", 2},
    };
    std::size_t turn = 0;  // under sanitizers each command runs with every fourth redirection
    for (const Command& command : commands) {
        const test::Outcome open = run(command.arguments, "");
        ASSERT_EQ(open.status, command.status) << command.arguments << "\n" << open.err;
        ASSERT_EQ(open.out.empty(), !command.prints) << command.arguments << "\n" << open.out;
        const std::string written = take(command.file);
        for (const Redirection& redirection : redirections) {
            if (OCTETRA_SANITIZED && turn++ % 4 != 0) continue;
            SCOPED_TRACE(command.arguments + " " + redirection.text);
            const bool is_lost = redirection.loses_results && command.prints;
            EXPECT_EQ(run(command.arguments, redirection.text).status,
                      is_lost ? 3 : command.status);
            EXPECT_TRUE(take(command.file) == written);
        }
    }
}

TEST_F(Streams, ThatLoseResultsAreNamed) {
    const std::string message = "octetra: standard output cannot be written\n";
    for (const std::string redirection : {">&-", ">/dev/full", "<&- >&-"}) {
        EXPECT_EQ(run("info gear.ele", redirection).err, message) << redirection;
        EXPECT_EQ(run("compare gear.ele fine.mesh", redirection).err, message) << redirection;
        EXPECT_EQ(run("refine gear.ele --all -o f.mesh", redirection).err, message) << redirection;
    }
    EXPECT_THAT(run("info nothing.ele", "<&- >&-").err, HasSubstr("octetra: nothing.ele: "));
}

/// A pipe whose reader exits before anything is written.
TEST_F(Streams, WithoutAReaderDoNotEndTheWork) {
    const auto piped = test::run_program(
        {"/bin/bash", "-c",
         "(sleep 0.3; exec " OCTETRA_PROGRAM " refine gear.ele --all -o out.mesh) | true; "
         "exit ${PIPESTATUS[0]}"},
        folder.path());
    EXPECT_EQ(piped.status, 0);
    EXPECT_EQ(piped.err, "");
    EXPECT_TRUE(take("out.mesh") == test::content_of(folder / "fine.mesh"));
    for (const auto& [arguments, status] : std::vector<std::pair<std::string, int>>{
             {"info gear.ele", 0}, {"--help", 0}, {"compare gear.ele fine.mesh", 1}}) {
        const auto run = test::run_program({"/bin/bash", "-c",
                                            "(sleep 0.3; exec " OCTETRA_PROGRAM " " + arguments +
                                                ") | true; exit ${PIPESTATUS[0]}"},
                                           folder.path());
        EXPECT_EQ(run.status, status) << arguments;
        EXPECT_EQ(run.err, "") << arguments;
    }
    const auto errors_piped =
        test::run_program({"/bin/bash", "-c",
                           "(sleep 0.3; exec " OCTETRA_PROGRAM " info nothing.ele) 2>&1 | true; "
                           "exit ${PIPESTATUS[0]}"},
                          folder.path());
    EXPECT_EQ(errors_piped.status, 2);
}

TEST_F(Streams, OfRanksThatCannotBeUsedChangeNoFileAndNoStatusEither) {
    const std::vector<Command> commands{
        {"refine gear.ele --all -o out.mesh", 0, true, "out.mesh"},
        {"info nothing.ele", 2},
        {"verify fine.mesh gear.ele", 1, true},
    };
    for (const Command& command : commands) {
        const test::Outcome open = run_on_two(command.arguments, "");
        ASSERT_EQ(open.status, command.status) << command.arguments << "\n" << open.err;
        const std::string written = take(command.file);
        for (const Redirection& redirection :
             {Redirection{"2>&-"}, {"2>/dev/full"}, {"<&- >&- 2>&-", true}, {">/dev/full", true}}) {
            SCOPED_TRACE(command.arguments + " " + redirection.text);
            const bool is_lost = redirection.loses_results && command.prints;
            EXPECT_EQ(run_on_two(command.arguments, redirection.text).status,
                      is_lost ? 3 : command.status);
            EXPECT_TRUE(take(command.file) == written);
        }
    }
}

}  // namespace
}  // namespace octetra
