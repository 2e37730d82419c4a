#pragma once

#include <string>

#include "properties/case.hpp"
#include "properties/case_files.hpp"
#include "properties/laws.hpp"

namespace octetra::properties {

/// On the first rank, within lead(): what the law says of the case; an exception is a fault, too.
/// The case is on disk meanwhile, as LAW-running-PID in found_folder(). If anything dies or waits
/// for ever, it stays there. Waiting ends the program after 120 seconds of the first rank's
/// processor time, which passes while MPI waits; OCTETRA_CPU_SECONDS is another number of them. For
/// what waits otherwise, ten times as long by the clock.
[[nodiscard]] std::string judge(const Law& law, const Case& c);

/// The simplest case that the finding's case leads to and that still breaks its law. For cases that
/// rapidcheck has not drawn, and so does not shrink.
[[nodiscard]] Finding shrunk(Finding finding);

}  // namespace octetra::properties
