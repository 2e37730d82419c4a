#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <ctime>
#include <fstream>
#include <string>

/// What benchmarks measure of the process that they are in.
namespace octetra::bench {

inline double seconds_of(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// By the wall clock, from some moment on.
inline double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

/// Of the processor, in the program and in the kernel. Waiting for other ranks counts, too: they
/// are asked over and over.
inline double processor_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

/// The most memory that this process has held so far.
inline std::uint64_t peak_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// The most memory that this process has held since this was last called, or ever, if it was not.
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
