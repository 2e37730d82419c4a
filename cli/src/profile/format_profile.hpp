#pragma once

#include <string>

#include <octetra/distributed/profile.hpp>

/// Output of a profile as a table, as JSON, and for a trace viewer.
///
/// The JSON text is one object. Names are stable; new ones may be added. The version is incremented
/// if the meaning of a name changes.
///
///     format             "octetra profile"
///     version            1
///     ranks              number of ranks
///     seconds            wall-clock time of the run, from reading the mesh to the end of writing
///     peak_memory_bytes  maximum resident memory; 0 if the system does not provide it
///     levels             [{level, cells, cells_touched, peak_memory_bytes}, ...]: after each
///                        level, and before the first as level 0; cells_touched is the number of
///                        cells that the level inspected (see ProfiledLevel); the memory is the
///                        maximum so far
///     phases             [{phase, level, computing_seconds, communicating_seconds, messages,
///                        bytes, collectives, collective_bytes, rounds}, ...]: for each phase of
///                        each level, with level 0 for phases outside levels; the figures are
///                        explained at PhaseCounts
///
/// Every figure is {min, mean, max, of_rank: [...]} over ranks; additive figures (cells, messages
/// etc., but not rounds) also have a `sum`. The seconds of all phases of a rank add up to its
/// `seconds`: the phase "level" is the rest of a level outside other phases, "rest" the rest of the
/// run.
///
/// The trace uses the JSON format of Chrome's trace events, which ui.perfetto.dev reads: a process
/// for each rank, with one lane of spans (`"ph": "X"`), phases and the communications within them
/// (`"cat"`), in microseconds since the barrier at which the profile began.
namespace octetra::cli {

/// Lines of at most 100 columns. Phases are summed over levels; then a line for each level.
[[nodiscard]] std::string format_profile_table(const distributed::GatheredProfile& profile);

/// A line for each phase and level, and a line end.
[[nodiscard]] std::string format_profile_json(const distributed::GatheredProfile& profile);

/// A line for each span.
[[nodiscard]] std::string format_trace(const distributed::GatheredProfile& profile);

}  // namespace octetra::cli
