#pragma once

#include <string>

#include "properties/case.hpp"
#include "properties/case_files.hpp"
#include "properties/laws.hpp"

namespace octetra::properties {

/// To be called on the first rank, within run_on_first_rank(). Returns the law's verdict on the
/// case; an exception is a fault, too. Meanwhile the case is on disk as LAW-running-PID in
/// found_folder(), and remains there if a rank dies or blocks. A blocked program ends after 120
/// seconds (or OCTETRA_CPU_SECONDS) of the first rank's processor time, which passes while MPI
/// waits, and in any case after ten times as long by the clock.
[[nodiscard]] std::string judge(const Law& law, const Case& c);

/// The simplest case that simplification of the finding's case reaches and that still breaks its
/// law. For cases that are not drawn, and therefore not shrunk, by rapidcheck.
[[nodiscard]] Finding shrunk(Finding finding);

}  // namespace octetra::properties
