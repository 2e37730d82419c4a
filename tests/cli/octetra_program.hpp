#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "support/run_program.hpp"

namespace octetra::test {

/// Runs "octetra ARGUMENTS" in a folder.
inline Outcome octetra(const std::string& arguments, const TemporaryFolder& folder) {
    return run_program(words(std::string(OCTETRA_PROGRAM) + " " + arguments), folder.path());
}

/// The same under mpirun. The output is that of all ranks.
inline Outcome octetra_on(int ranks, const std::string& arguments, const TemporaryFolder& folder) {
    return run_program(words(std::string(OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh ") +
                             std::to_string(ranks) + " " + OCTETRA_PROGRAM + " " + arguments),
                       folder.path());
}

/// The numbers of ranks on which to repeat a comparison: all of these if the environment has
/// OCTETRA_EVERY_RANK_COUNT, as set by `./dev campaign nightly`; otherwise only the first.
inline std::vector<int> rank_counts(std::vector<int> ranks) {
    if (std::getenv("OCTETRA_EVERY_RANK_COUNT") == nullptr) ranks.resize(1);
    return ranks;
}

inline std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace octetra::test
