#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <ctime>
#include <fstream>
#include <string>

/// Measurements of the current process.
namespace octetra::bench {

inline double seconds_of(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Wall-clock seconds since an arbitrary moment.
inline double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

/// Processor seconds, in user and kernel mode. Waiting for other ranks counts as well, because MPI
/// polls.
inline double processor_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

/// The peak memory of this process so far.
inline std::uint64_t peak_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// The peak memory of this process since the last call, or since its start.
inline std::uint64_t peak_bytes_since_last() {
    std::uint64_t kilobytes = 0;
    std::ifstream status("/proc/self/status");
    for (std::string word; kilobytes == 0 && status >> word;) {
        if (word == "VmHWM:") status >> kilobytes;
    }
    std::ofstream("/proc/self/clear_refs") << 5;
    return kilobytes * 1024;
}

}  // namespace octetra::bench
