#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <ctime>

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

}  // namespace octetra::bench
