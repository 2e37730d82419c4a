#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/distributed/communicator.hpp>

/// Where the time goes: seconds, messages and bytes of each phase on each process, and how many
/// cells each has. A Communicator carries a profile, or none; without one nothing is measured, and
/// no clock is read.
namespace octetra::distributed {

/// What a profile keeps: sums for each phase, or also when each phase and each communication began
/// and how long it took.
enum class ProfileDetail { sums, spans };

/// Seconds as they pass, or those in which a processor works for the calling thread: what a phase
/// would take a process that has a processor to itself, however many share one now.
enum class ProfileClock { wall, processor };

/// Collective. The same processes, which from now on measure themselves. The clocks of all start
/// here, at a barrier. Until the first Phase, and whenever none is open, time counts as "rest".
[[nodiscard]] Communicator profiled(const Communicator& processes, ProfileDetail detail,
                                    ProfileClock clock = ProfileClock::wall);

/// Time from here to the end of the scope is that of a phase, apart from the time of phases inside
/// it: so every moment belongs to one phase. Communication by `processes` is counted there too. Not
/// collective.
class Phase {
public:
    /// `name` must outlive the profile: a literal of at most 31 characters.
    Phase(const Communicator& processes, const char* name) : profile_(processes.profile()) {
        if (profile_ != nullptr) begin(name);
    }
    /// This phase and those inside it are of this refinement level, counted from 1.
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

/// Runs work() as a phase, and returns what it returns.
template <class F>
auto in_phase(const Communicator& processes, const char* name, F&& work) {
    const Phase phase(processes, name);
    return work();
}

/// Notes that a round of synchronisation begins, in the current phase. Not collective.
void note_round(const Communicator& processes);

/// Notes how many cells this process has after a level, or with level 0 before the first, and how
/// many of the cells before the level had to be looked at. Not collective.
void note_cells(const Communicator& processes, int level, std::uint64_t cells,
                std::uint64_t touched);

/// What one process did in one phase of one level.
struct PhaseCounts {
    double computing_seconds = 0;
    /// In calls of MPI, most of it usually waiting for others.
    double communicating_seconds = 0;
    /// Messages from one process to another, counted where they are sent, and the bytes in them.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    /// Calls in which all processes take part (reductions, broadcasts), each counted once on every
    /// process, and the bytes of the buffers that it handed over or got. How many messages MPI
    /// makes of a call is its own affair.
    std::uint64_t collectives = 0;
    std::uint64_t collective_bytes = 0;
    std::uint64_t rounds = 0;  ///< of synchronisation

    friend bool operator==(const PhaseCounts&, const PhaseCounts&) = default;
};

struct ProfiledPhase {
    std::string name;
    int level = 0;                     ///< 0: of no level
    std::vector<PhaseCounts> of_rank;  ///< [rank]
};

struct ProfiledLevel {
    int level = 0;  ///< 0: before the first
    std::vector<std::uint64_t> cells_of_rank;
    /// What each process had to look at: a cell counts once if the selection judged it, and once if
    /// its edges were looked at. Of a process that goes through all of its cells, twice their
    /// number at most; else in proportion to those that are bisected, and to those that a criterion
    /// has to judge.
    std::vector<std::uint64_t> cells_touched_of_rank;
    /// The most memory, in bytes, that each process has held so far.
    std::vector<std::uint64_t> peak_memory_of_rank;
};

/// A phase or, within one, a communication: when it began, on a clock that all processes share as
/// well as a barrier lets them, and how long it took.
struct Span {
    std::array<char, 32> name{};  ///< ends with a zero
    std::int64_t begin_nanoseconds = 0;
    std::int64_t nanoseconds = 0;
    std::int32_t level = 0;
    bool is_communication = false;
    std::uint64_t messages = 0;  ///< sent by this communication, and their bytes
    std::uint64_t bytes = 0;
};

/// The profiles of all processes together: plain figures. Every vector over ranks has one entry for
/// each process.
struct GatheredProfile {
    std::vector<double> seconds_of_rank;  ///< since profiled(); the sum of a rank's phases
    /// The most memory that each process has held resident, in bytes; 0 where the system does not
    /// tell.
    std::vector<std::uint64_t> peak_memory_of_rank;
    std::vector<ProfiledPhase> phases;  ///< in the order in which they first began
    std::vector<ProfiledLevel> levels;  ///< ascending
    /// Of each process, in the order in which they began; empty without ProfileDetail::spans.
    std::vector<std::vector<Span>> spans_of_rank;
};

/// Collective. Ends the measurement, so that this gathering is not in it: the first process gets
/// what all have measured, the others nothing. `processes` must come from profiled(), and no phase
/// be open. Throws std::logic_error otherwise.
[[nodiscard]] GatheredProfile gather_profile(const Communicator& processes);

}  // namespace octetra::distributed
