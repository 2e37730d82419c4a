#pragma once

#include <string>

#include "support/run_program.hpp"

namespace octetra::test {

/// Runs "octetra ARGUMENTS" in a folder.
inline Outcome octetra(const std::string& arguments, const TemporaryFolder& folder) {
    return run_program(words(std::string(OCTETRA_PROGRAM) + " " + arguments), folder.path());
}

/// The same under mpirun. Its output is that of all ranks.
inline Outcome octetra_on(int ranks, const std::string& arguments, const TemporaryFolder& folder) {
    return run_program(words(std::string(OCTETRA_SOURCE_DIR "/tests/support/mpirun.sh ") +
                             std::to_string(ranks) + " " + OCTETRA_PROGRAM + " " + arguments),
                       folder.path());
}

inline std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace octetra::test
