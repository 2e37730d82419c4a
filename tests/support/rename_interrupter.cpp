/// To be preloaded (LD_PRELOAD) into a program: after each of its calls of rename() but the last of
/// OCTETRA_RENAMES it gets SIGTERM; instead of the one numbered OCTETRA_KILLED_AT_RENAME, from 1,
/// SIGKILL.

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
