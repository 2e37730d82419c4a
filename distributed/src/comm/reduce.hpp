#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>

#include <octetra/distributed/profile.hpp>

#include "profile/recorder.hpp"

namespace octetra::distributed {

/// Collective. Each number becomes the result of the operation on those at its position on all
/// processes.
inline void reduce(std::span<std::uint64_t> numbers, MPI_Op operation, MPI_Comm comm,
                   Profile* profile) {
    const Communication communication(profile, "reduction");
    communication.count_collective(numbers.size_bytes());
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T,
                  operation, comm);
}
[[nodiscard]] inline std::uint64_t reduced(std::uint64_t number, MPI_Op operation, MPI_Comm comm,
                                           Profile* profile) {
    reduce(std::span(&number, 1), operation, comm, profile);
    return number;
}

}  // namespace octetra::distributed
