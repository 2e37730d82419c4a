#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <octetra/distributed/profile.hpp>

namespace octetra::distributed {

/// The profile of one process. At any time one phase is current, and time counts as its computing
/// or its communicating time: each change adds the time since the previous change.
class Profile {
public:
    using Nanoseconds = std::int64_t;

    /// The counts of one phase of one level; names point to string literals.
    struct Record {
        const char* name = nullptr;
        int level = 0;
        Nanoseconds computing = 0;
        Nanoseconds communicating = 0;
        PhaseCounts counts;  // without the seconds
    };
    struct LevelRecord {
        int level = 0;
        std::uint64_t cells = 0;
        std::uint64_t touched = 0;
        std::uint64_t peak_memory = 0;
    };

    /// Starts the clock, in the phase "rest".
    Profile(ProfileDetail detail, ProfileClock clock);

    void begin_phase(const char* name) { begin_phase(name, current().level); }
    void begin_phase(const char* name, int level);
    void end_phase();
    void begin_communication(const char* name);
    void end_communication();
    [[nodiscard]] PhaseCounts& counts() { return current().counts; }
    void note_cells(int level, std::uint64_t cells, std::uint64_t touched);
    /// Called before a level: records the number of cells if no level has been recorded.
    void note_first_cells(int level, std::uint64_t cells) {
        if (levels_.empty()) note_cells(level, cells, 0);
    }

    /// Adds the time since the last change. Throws std::logic_error if a phase is open.
    void finish();

    [[nodiscard]] const std::vector<Record>& records() const { return records_; }
    [[nodiscard]] const std::vector<LevelRecord>& levels() const { return levels_; }
    [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }

private:
    struct Open {
        std::size_t record = 0;
        std::size_t span = 0;
    };

    [[nodiscard]] Record& current() { return records_[open_.back().record]; }
    [[nodiscard]] std::size_t record_of(std::string_view name, int level);
    Nanoseconds add_elapsed();
    void begin_span(const char* name, Nanoseconds now, bool is_communication);

    [[nodiscard]] Nanoseconds now() const;

    bool keeps_spans_;
    ProfileClock clock_;
    Nanoseconds start_ = now();
    bool communicates_ = false;
    Nanoseconds attributed_ = 0;  // the time until which all time is attributed
    std::vector<Record> records_;
    std::vector<Open> open_;     // the innermost phase last; "rest" first
    PhaseCounts counts_before_;  // of the current phase, at the begin of the communication
    std::vector<LevelRecord> levels_;
    std::vector<Span> spans_;
};

/// Returns the peak resident memory of this process, in bytes; 0 if the system does not report it.
[[nodiscard]] std::uint64_t peak_memory();

/// Attributes the time until the end of the scope to communication of the current phase. With a
/// null profile nothing is measured.
class Communication {
public:
    Communication(Profile* profile, const char* name) : profile_(profile) {
        if (profile_ != nullptr) profile_->begin_communication(name);
    }
    ~Communication() {
        if (profile_ != nullptr) profile_->end_communication();
    }
    Communication(const Communication&) = delete;
    Communication& operator=(const Communication&) = delete;
    Communication(Communication&&) = delete;
    Communication& operator=(Communication&&) = delete;

    void count_message(std::size_t bytes) const {
        if (profile_ == nullptr) return;
        profile_->counts().messages += 1;
        profile_->counts().bytes += bytes;
    }
    void count_collective(std::size_t bytes) const {
        if (profile_ == nullptr) return;
        profile_->counts().collectives += 1;
        profile_->counts().collective_bytes += bytes;
    }

private:
    Profile* profile_;
};

}  // namespace octetra::distributed
