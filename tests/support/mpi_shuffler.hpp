#pragma once

#include <cstdint>

/// Bad weather: mpi_shuffler.cpp stands between a program and MPI (the profiling interface, PMPI).
/// It holds sends back and lets them go one by one, to the receivers in random order, while the
/// program waits; a receiver that would take a message from anybody gets one from a random sender;
/// and any call may be late. Two messages from one rank to another keep their order, as MPI
/// promises. The seed is OCTETRA_SHUFFLE_SEED, or 1; ranks draw differently.
namespace octetra::test {

struct ShuffleCounts {
    std::uint64_t held_back = 0;  ///< messages sent later than the program meant to
    std::uint64_t overtaken = 0;  ///< of them, those let go after one that was meant to follow
    std::uint64_t late_calls = 0;
};

/// Of this process, since it began.
[[nodiscard]] ShuffleCounts shuffle_counts();

[[nodiscard]] std::uint64_t shuffle_seed();

}  // namespace octetra::test
