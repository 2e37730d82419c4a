#include <octetra/distributed/profile.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "profile/recorder.hpp"

namespace octetra::distributed {
namespace {

/// A record of one process as sent to the first process.
struct PhaseMessage {
    std::array<char, 32> name{};
    std::int64_t level = 0;
    PhaseCounts counts;
};

double seconds(Profile::Nanoseconds nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; }

std::vector<PhaseMessage> messages_of(const Profile& profile) {
    std::vector<PhaseMessage> messages;
    for (const Profile::Record& record : profile.records()) {
        PhaseMessage& message = messages.emplace_back();
        const std::string_view name(record.name);
        std::ranges::copy(name.substr(0, message.name.size() - 1), message.name.begin());
        message.level = record.level;
        message.counts = record.counts;
        message.counts.computing_seconds = seconds(record.computing);
        message.counts.communicating_seconds = seconds(record.communicating);
    }
    return messages;
}

ProfiledPhase& phase_of(GatheredProfile& all, const PhaseMessage& message, std::size_t ranks) {
    for (ProfiledPhase& phase : all.phases) {
        if (phase.level == message.level && phase.name == message.name.data()) return phase;
    }
    return all.phases.emplace_back(ProfiledPhase{
        message.name.data(), static_cast<int>(message.level), std::vector<PhaseCounts>(ranks)});
}

void store_phases(const std::vector<std::vector<PhaseMessage>>& from_each, GatheredProfile& all) {
    all.seconds_of_rank.resize(from_each.size());
    for (std::size_t r = 0; r < from_each.size(); ++r) {
        for (const PhaseMessage& message : from_each[r]) {
            phase_of(all, message, from_each.size()).of_rank[r] = message.counts;
            all.seconds_of_rank[r] +=
                message.counts.computing_seconds + message.counts.communicating_seconds;
        }
    }
}

void store_levels(const std::vector<std::vector<Profile::LevelRecord>>& from_each,
                  GatheredProfile& all) {
    const std::size_t ranks = from_each.size();
    for (std::size_t r = 0; r < ranks; ++r) {
        for (const Profile::LevelRecord& record : from_each[r]) {
            auto entry =
                std::ranges::lower_bound(all.levels, record.level, {}, &ProfiledLevel::level);
            if (entry == all.levels.end() || entry->level != record.level) {
                const std::vector<std::uint64_t> zeros(ranks);
                entry = all.levels.insert(entry, {record.level, zeros, zeros, zeros});
            }
            entry->cells_of_rank[r] = record.cells;
            entry->cells_touched_of_rank[r] = record.touched;
            entry->peak_memory_of_rank[r] = record.peak_memory;
        }
    }
}

}  // namespace

Communicator profiled(const Communicator& processes, ProfileDetail detail, ProfileClock clock) {
    (void)processes.sum(0);  // a barrier
    return processes.with_profile(std::make_shared<Profile>(detail, clock));
}

void Phase::begin(const char* name) { profile_->begin_phase(name); }
void Phase::begin(const char* name, int level) { profile_->begin_phase(name, level); }
void Phase::end() { profile_->end_phase(); }

void note_round(const Communicator& processes) {
    if (Profile* const profile = processes.profile()) profile->counts().rounds += 1;
}

void note_cells(const Communicator& processes, int level, std::uint64_t cells,
                std::uint64_t touched) {
    if (Profile* const profile = processes.profile()) profile->note_cells(level, cells, touched);
}

GatheredProfile gather_profile(const Communicator& processes) {
    Profile* const profile = processes.profile();
    if (profile == nullptr) throw std::logic_error("there is no profile to gather");
    profile->finish();
    const Communicator unmeasured = processes.with_profile(nullptr);
    GatheredProfile all;
    store_phases(unmeasured.gather(messages_of(*profile)), all);
    store_levels(unmeasured.gather(profile->levels()), all);
    for (const auto& peak : unmeasured.gather(std::vector{peak_memory()})) {
        all.peak_memory_of_rank.push_back(peak.front());
    }
    all.spans_of_rank = unmeasured.gather(profile->spans());
    return all;
}

}  // namespace octetra::distributed
