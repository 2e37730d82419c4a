#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// Counts the MPI calls of this process: mpi_counter.cpp wraps MPI through the profiling interface,
/// PMPI, independently of the engine's own counts.
namespace octetra::test {

struct MpiCounts {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::uint64_t collectives = 0;
    std::uint64_t collective_bytes = 0;
    std::int64_t nanoseconds = 0;  ///< in calls that send, wait, receive, or are collective
};

/// The calls that are counted.
inline constexpr std::array<std::string_view, 14> counted_calls{
    "MPI_Isend",   "MPI_Issend",  "MPI_Mprobe",    "MPI_Improbe",   "MPI_Mrecv",
    "MPI_Waitall", "MPI_Testall", "MPI_Test",      "MPI_Ibarrier",  "MPI_Allreduce",
    "MPI_Exscan",  "MPI_Bcast",   "MPI_Allgather", "MPI_Allgatherv"};

/// Counts since the start of the program.
[[nodiscard]] MpiCounts mpi_counts();

}  // namespace octetra::test
