#pragma once

#include <string>

#include "properties/case_files.hpp"

namespace octetra::properties {

/// How the replay of a finding ended: the law held; it was broken; or there was no verdict, as a
/// rank died, or waited until time was up.
enum class Ending { held, broken, died };

/// Replays a finding on its ranks, by `program`, which has the tests of findings_test.cpp, in an
/// mpirun of its own, and for `seconds` by the clock at most. The environment of this process
/// becomes that of the program. Throws std::runtime_error, with what was printed, if the program
/// came to no verdict without ever having begun with the case.
[[nodiscard]] Ending replay(const Finding& finding, const std::string& program, double seconds);

}  // namespace octetra::properties
