#include "files/output/unfinished_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>

#include <octetra/core/files/unfinished_files.hpp>

namespace octetra {
namespace {

/// A signal handler may look at this at any time: each path is complete before it is marked as
/// used.
struct Slot {
    std::array<char, 4096> path{};
    std::atomic<bool> used = false;
    std::atomic<bool> taken = false;
};

constexpr std::size_t slot_count = 8;
std::array<Slot, slot_count> slots;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path) : slot_(slot_count) {
    // Relative to where the program now is, which may change before the signal comes.
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

void remove_unfinished_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.used) ::unlink(slot.path.data());
    }
}

}  // namespace octetra
