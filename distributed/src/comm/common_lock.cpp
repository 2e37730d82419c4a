#include "comm/common_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <random>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace octetra::distributed {
namespace {

/// Draws a file name that is unique and cannot be guessed.
std::vector<std::uint32_t> draw_name() {
    std::random_device rng;
    return {rng(), rng(), rng(), rng()};
}

}  // namespace

int open_common_lock(const Communicator& processes) {
    std::vector<std::uint32_t> name;
    if (processes.is_first()) name = draw_name();
    processes.broadcast(name);
    std::error_code no_folder;
    const std::filesystem::path path = std::filesystem::temp_directory_path(no_folder) /
                                       fmt::format("octetra-{}", fmt::join(name, "-"));
    constexpr mode_t for_its_owner = 0600;
    const int lock =
        no_folder ? -1
                  : ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, for_its_owner);
    (void)processes.sum(0);  // all processes have opened the file
    ::unlink(path.c_str());
    return lock;
}

bool try_claim(int lock) {
    if (lock < 0) return true;
    while (::flock(lock, LOCK_EX) != 0) {
        if (errno != EINTR) return true;
    }
    // The claim must persist after its holder exits: it is recorded in the length of the file.
    struct stat file {};
    if (::fstat(lock, &file) == 0 && file.st_size > 0) return false;
    // allocates no disk space; if it failed, other processes would claim, too
    (void)!::ftruncate(lock, 1);
    return true;
}

}  // namespace octetra::distributed
