#include "files/output/unfinished_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include <octetra/core/files/unfinished_files.hpp>

namespace octetra {
namespace {

/// A signal handler may read a slot at any time, so its path is complete before it is marked as
/// used.
struct Slot {
    std::array<char, 4096> path{};
    std::atomic<bool> used = false;
    std::atomic<bool> taken = false;
};

constexpr std::size_t slot_count = 8;
std::array<Slot, slot_count> slots;
static_assert(std::atomic<bool>::is_always_lock_free);

/// Committing a set of files and removing temporary files exclude each other. The handler may run
/// in another thread than the writer, for example in one of MPI.
enum class Activity { neither, putting_in_place, removing };
std::atomic<Activity> activity = Activity::neither;
std::atomic<int> deferred_signal = 0;
static_assert(std::atomic<Activity>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path) : slot_(slot_count) {
    // The working directory may change before a signal arrives.
    const std::string absolute = std::filesystem::absolute(path).native();
    if (absolute.size() >= Slot{}.path.size()) return;
    for (std::size_t s = 0; s < slot_count; ++s) {
        if (slots[s].taken.exchange(true)) continue;
        std::ranges::copy(absolute, slots[s].path.begin());
        slots[s].path[absolute.size()] = '\0';
        slots[s].used = true;
        slot_ = s;
        return;
    }
}

UnfinishedFile::~UnfinishedFile() {
    if (slot_ == slot_count) return;
    slots[slot_].used = false;
    slots[slot_].taken = false;
}

DeferredTermination::DeferredTermination() {
    Activity now = Activity::neither;
    if (activity.compare_exchange_strong(now, Activity::putting_in_place)) return;
    while (true) ::pause();  // the handler, in another thread, is about to end the program
}

DeferredTermination::~DeferredTermination() {
    activity = Activity::neither;
    if (const int signal = deferred_signal.exchange(0); signal != 0) std::raise(signal);
}

bool remove_unfinished_files(int signal) noexcept {
    deferred_signal = signal;  // before `activity` is read, so that the signal is not missed
    Activity now = Activity::neither;
    if (!activity.compare_exchange_strong(now, Activity::removing) &&
        now == Activity::putting_in_place) {
        return false;
    }
    for (const Slot& slot : slots) {
        if (slot.used) ::unlink(slot.path.data());
    }
    return true;
}

}  // namespace octetra
