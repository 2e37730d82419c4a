#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The most bytes of one MPI message. What a process has no memory for it receives into a buffer of
/// this size, piece by piece.
constexpr std::size_t most_bytes = std::size_t{1} << 20U;

/// A duplicate of a communicator of the program's. It is kept until MPI_Finalize: MPI_Comm_free is
/// collective, and each process may destroy its Communicator at another time, a Python process at
/// garbage collection, or after MPI_Finalize.
struct Duplicate {
    MPI_Comm comm = MPI_COMM_NULL;
    std::uint64_t number = 0;  ///< names it on all of its processes
    bool is_used = false;      ///< on this process
};

struct Communicator::Mpi {
    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0;
    int size = 1;
    std::vector<int> every_rank;
    // For a process that has no memory at the time: what it throws away, and its empty messages.
    std::unique_ptr<std::byte[]> unwanted{new std::byte[most_bytes]};
    std::unique_ptr<MPI_Request[]> requests;
    mutable bool is_watched = false;        ///< by Watch, on all processes
    mutable unsigned sparse_exchanges = 0;  ///< so far

    /// Allocates all that is needed. Not collective.
    explicit Mpi(MPI_Comm original);
    /// Calls no function of MPI.
    ~Mpi();
    Mpi(const Mpi&) = delete;
    Mpi& operator=(const Mpi&) = delete;
    Mpi(Mpi&&) = delete;
    Mpi& operator=(Mpi&&) = delete;

    /// Collective in `original`. A duplicate for each process's group: one that is used on none of
    /// them, if there is one. A process without memory passes null. False, on all, if one has.
    [[nodiscard]] static bool give_duplicate(MPI_Comm original, Mpi* group);

private:
    std::list<Duplicate> fresh_;      ///< room for one
    Duplicate* duplicate_ = nullptr;  ///< of which `comm` is
};

}  // namespace octetra::distributed
