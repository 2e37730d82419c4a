#include "properties/replay.hpp"

#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "support/run_program.hpp"

namespace octetra::properties {
namespace {

/// Runs in the foreground, so that Ctrl-C ends it together with this process.
test::Outcome run(const Finding& finding, const std::string& program, double seconds,
                  const std::filesystem::path& folder) {
    return test::run_program(
        {"timeout", "--foreground", fmt::format("{:.3f}", seconds),
         OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh", std::to_string(finding.ranks), program,
         "--gtest_brief=1", "--gtest_filter=*Findings*"},
        folder);
}

}  // namespace

Ending replay(const Finding& finding, const std::string& program, double seconds) {
    const test::TemporaryFolder folder;
    const auto file = write_finding(finding, folder.path(), "finding");
    const auto running = folder / "running";
    ::setenv("OCTETRA_FINDING", file.c_str(), 1);
    ::setenv("OCTETRA_FOUND", running.c_str(), 1);
    const test::Outcome outcome = run(finding, program, seconds, folder.path());
    const bool began = std::filesystem::exists(running);
    // judge() removes the file that it writes there as soon as the verdict is known.
    if (began && !std::filesystem::is_empty(running)) return Ending::died;
    if (began && outcome.status == 0) return Ending::held;
    if (began && outcome.out.find("[  FAILED  ]") != outcome.out.npos) return Ending::broken;
    throw std::runtime_error(fmt::format("the replay ended with status {} and no verdict:\n{}{}",
                                         outcome.status, outcome.out, outcome.err));
}

}  // namespace octetra::properties
