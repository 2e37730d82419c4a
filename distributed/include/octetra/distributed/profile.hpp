#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/distributed/communicator.hpp>

/// Profiling: seconds, messages and bytes of each phase on each process, and the number of cells of
/// each process. A Communicator has a profile or none; without a profile nothing is measured and no
/// clock is read.
namespace octetra::distributed {

/// The data that a profile records: sums for each phase only, or also the begin and duration of
/// each phase and each communication.
enum class ProfileDetail { sums, spans };

/// The clock: elapsed time, or the processor time of the calling thread, which is the time that a
/// phase would take if each process had a processor of its own.
enum class ProfileClock { wall, processor };

/// Collective. Returns the communicator with a new profile. The clocks of all processes start at a
/// barrier in this function. Time outside any Phase counts as "rest".
[[nodiscard]] Communicator profiled(const Communicator& processes, ProfileDetail detail,
                                    ProfileClock clock = ProfileClock::wall);

/// Attributes the time until the end of the scope to a phase, without the time of nested phases:
/// each moment belongs to exactly one phase. Communication by `processes` is counted likewise. Not
/// collective.
class Phase {
public:
    /// `name` must outlive the profile: a literal of at most 31 characters.
    Phase(const Communicator& processes, const char* name) : profile_(processes.profile()) {
        if (profile_ != nullptr) begin(name);
    }
    /// Attributes this phase and nested ones to a refinement level, counted from 1.
    Phase(const Communicator& processes, const char* name, int level)
        : profile_(processes.profile()) {
        if (profile_ != nullptr) begin(name, level);
    }
    ~Phase() {
        if (profile_ != nullptr) end();
    }
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;
    Phase(Phase&&) = delete;
    Phase& operator=(Phase&&) = delete;

private:
    void begin(const char* name);
    void begin(const char* name, int level);
    void end();
    Profile* profile_;
};

/// Runs work() as a phase, and returns its result.
template <class F>
auto in_phase(const Communicator& processes, const char* name, F&& work) {
    const Phase phase(processes, name);
    return work();
}

/// Counts a round of synchronisation in the current phase. Not collective.
void note_round(const Communicator& processes);

/// Records the number of cells of this process after a level (level 0: before the first level), and
/// how many cells of the previous level were processed; see ProfiledLevel. Not collective.
void note_cells(const Communicator& processes, int level, std::uint64_t cells,
                std::uint64_t touched);

/// Counts of one process in one phase of one level.
struct PhaseCounts {
    double computing_seconds = 0;
    /// In calls of MPI; most of it is usually waiting for other processes.
    double communicating_seconds = 0;
    /// Messages between two processes, counted at the sender, and their bytes.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    /// Calls of collective MPI operations (reductions, broadcasts), each counted once on every
    /// process, and the bytes of their buffers on this process. The messages that MPI sends for a
    /// collective operation are not counted.
    std::uint64_t collectives = 0;
    std::uint64_t collective_bytes = 0;
    std::uint64_t rounds = 0;  ///< of synchronisation

    friend bool operator==(const PhaseCounts&, const PhaseCounts&) = default;
};

struct ProfiledPhase {
    std::string name;
    int level = 0;                     ///< 0: outside levels
    std::vector<PhaseCounts> of_rank;  ///< [rank]
};

struct ProfiledLevel {
    int level = 0;  ///< 0: before the first level
    std::vector<std::uint64_t> cells_of_rank;
    /// The cells that each process processed: a cell counts once if the selection tested it, and
    /// once if its edges were processed. On a process that performs a full sweep this is at most
    /// twice the number of its cells; otherwise it is proportional to the number of bisected cells
    /// and of cells that a criterion tests.
    std::vector<std::uint64_t> cells_touched_of_rank;
    /// The peak memory of each process so far, in bytes.
    std::vector<std::uint64_t> peak_memory_of_rank;
};

/// A phase or, within a phase, a communication: its begin, on a clock that is common to all
/// processes within the accuracy of a barrier, and its duration.
struct Span {
    std::array<char, 32> name{};  ///< terminated by a zero
    std::int64_t begin_nanoseconds = 0;
    std::int64_t nanoseconds = 0;
    std::int32_t level = 0;
    bool is_communication = false;
    std::uint64_t messages = 0;  ///< sent by this communication, like the bytes
    std::uint64_t bytes = 0;
};

/// The profiles of all processes. Vectors over ranks have one entry for each process.
struct GatheredProfile {
    std::vector<double> seconds_of_rank;  ///< since profiled(); the sum of all phases
    /// The peak resident memory of each process in bytes; 0 if the system does not report it.
    std::vector<std::uint64_t> peak_memory_of_rank;
    std::vector<ProfiledPhase> phases;  ///< in the order of their first begin
    std::vector<ProfiledLevel> levels;  ///< ascending
    /// The spans of each process, in the order of their begin; empty without ProfileDetail::spans.
    std::vector<std::vector<Span>> spans_of_rank;
};

/// Collective. Ends the measurement, which excludes this function, and returns the profiles of all
/// processes on the first process, and an empty profile on the others. `processes` must have been
/// returned by profiled(), and no phase may be open; throws std::logic_error otherwise.
[[nodiscard]] GatheredProfile gather_profile(const Communicator& processes);

}  // namespace octetra::distributed
