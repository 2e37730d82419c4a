#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <numeric>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The most bytes of one MPI message. What a process has no memory for it receives into a buffer of
/// this size, piece by piece.
constexpr std::size_t most_bytes = std::size_t{1} << 20U;

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

    explicit Mpi(MPI_Comm original) {
        MPI_Comm_dup(original, &comm);
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
        every_rank.resize(static_cast<std::size_t>(size));
        std::iota(every_rank.begin(), every_rank.end(), 0);
        requests.reset(new MPI_Request[every_rank.size()]);
    }
    ~Mpi() {
        int finalized = 0;
        MPI_Finalized(&finalized);
        if (finalized == 0) MPI_Comm_free(&comm);
    }
    Mpi(const Mpi&) = delete;
    Mpi& operator=(const Mpi&) = delete;
    Mpi(Mpi&&) = delete;
    Mpi& operator=(Mpi&&) = delete;
};

}  // namespace octetra::distributed
