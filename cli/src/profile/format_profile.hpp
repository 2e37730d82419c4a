#pragma once

#include <string>

#include <octetra/distributed/profile.hpp>

/// A profile for people, for programs, and for a trace viewer.
///
/// The JSON is one object. Names stay; new ones may be added, and with a change of meaning the
/// version goes up.
///
///     format             "octetra profile"
///     version            1
///     ranks              how many
///     seconds            of the whole run, from before the mesh is read until all is written
///     peak_memory_bytes  the most that was resident; 0 where the system does not tell
///     levels             [{level, cells, cells_touched, peak_memory_bytes}, ...]: after each
///                        level, and before the first as level 0; how many cells the level looked
///                        at (see ProfiledLevel); the memory is the most so far
///     phases             [{phase, level, computing_seconds, communicating_seconds, messages,
///                        bytes, collectives, collective_bytes, rounds}, ...]: of each phase of
///                        each level, 0 for those of no level; the figures are explained at
///                        PhaseCounts
///
/// Every figure is {min, mean, max, of_rank: [...]} over ranks; those that add up (cells, messages
/// and so on, but not rounds) have their `sum`, too. The seconds of all phases of a rank add up to
/// its `seconds`: the phase "level" is what of a level is in no other phase, "rest" what of the
/// run.
///
/// The trace is in the JSON form of Chrome's trace events, which ui.perfetto.dev opens: a process
/// for each rank, in it one lane of spans (`"ph": "X"`), phases and within them communications
/// (`"cat"`), in microseconds from the barrier at which the profile began.
namespace octetra::cli {

/// Lines of at most 100 columns. Phases are summed over levels; then a line for each level.
[[nodiscard]] std::string format_profile_table(const distributed::GatheredProfile& profile);

/// A line for each phase and level, and a line end.
[[nodiscard]] std::string format_profile_json(const distributed::GatheredProfile& profile);

/// A line for each span.
[[nodiscard]] std::string format_trace(const distributed::GatheredProfile& profile);

}  // namespace octetra::cli
