#pragma once

#include <string>

#include "properties/case_files.hpp"

namespace octetra::properties {

/// The result of replaying a finding: the law held; it was broken; or there was no verdict, because
/// a rank died or the time limit expired.
enum class Ending { held, broken, died };

/// Replays a finding on its ranks in a separate mpirun, for at most `seconds` by the clock, with
/// `program`, which contains the tests of findings_test.cpp and inherits the environment. Throws
/// std::runtime_error, with the output, if the program ended without a verdict before it began with
/// the case.
[[nodiscard]] Ending replay(const Finding& finding, const std::string& program, double seconds);

}  // namespace octetra::properties
