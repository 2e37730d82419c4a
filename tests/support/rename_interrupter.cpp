/// To be preloaded (LD_PRELOAD) into a program: sends it SIGTERM after each of its OCTETRA_RENAMES
/// calls of rename() except the last; and SIGKILL in place of the call numbered
/// OCTETRA_KILLED_AT_RENAME, from 1.

#include <fcntl.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

int rename(const char* from, const char* to) noexcept {
    static int calls = 0;
    ++calls;
    const char* const killed_at = std::getenv("OCTETRA_KILLED_AT_RENAME");
    if (killed_at != nullptr && calls == std::atoi(killed_at)) std::raise(SIGKILL);
    const char* const text = std::getenv("OCTETRA_RENAMES");
    const long result = ::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
    if (text != nullptr && calls < std::atoi(text)) std::raise(SIGTERM);
    return static_cast<int>(result);
}
