#include "support/full_disk.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace {

/// Empty if no disk is full.
std::string full_beginning;

bool is_on_full_disk(int file) {
    if (full_beginning.empty()) return false;
    std::error_code ignored;
    const auto path =
        std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), ignored);
    return path.filename().native().starts_with(full_beginning);
}

}  // namespace

/// Replaces the C library's function in the whole program.
ssize_t pwrite(int file, const void* data, size_t size, off_t position) {
    if (is_on_full_disk(file)) {
        errno = ENOSPC;
        return -1;
    }
    return ::syscall(SYS_pwrite64, file, data, size, position);
}

namespace octetra::test {

FullDisk::FullDisk(std::string beginning) { full_beginning = std::move(beginning); }
FullDisk::~FullDisk() { full_beginning.clear(); }

}  // namespace octetra::test
