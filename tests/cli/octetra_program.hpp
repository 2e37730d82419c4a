#pragma once

#include <string>

#include <octetra/core/files.hpp>

#include "support/run_program.hpp"

namespace octetra::test {

/// Runs "octetra ARGUMENTS" in a folder.
inline Outcome octetra(const std::string& arguments, const TemporaryFolder& folder) {
    return run_program(words(std::string(OCTETRA_PROGRAM) + " " + arguments), folder.path());
}

}  // namespace octetra::test
