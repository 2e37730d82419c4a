#pragma once

#include <cstdint>

/// Simulates an adverse network: mpi_shuffler.cpp wraps MPI through the profiling interface, PMPI.
/// It holds sends back and releases them one by one, to the receivers in random order, while the
/// program waits; a receive from any source takes the message of a random sender; and any call may
/// be delayed. Two messages from one rank to another keep their order, as MPI guarantees. The seed
/// is OCTETRA_SHUFFLE_SEED, or 1; ranks draw differently.
namespace octetra::test {

struct ShuffleCounts {
    std::uint64_t held_back = 0;  ///< messages sent later than requested
    std::uint64_t overtaken = 0;  ///< those sent after a message that was requested later
    std::uint64_t late_calls = 0;
};

/// The counts of this process since its start.
[[nodiscard]] ShuffleCounts shuffle_counts();

[[nodiscard]] std::uint64_t shuffle_seed();

}  // namespace octetra::test
