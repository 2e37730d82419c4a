#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The maximum size of one MPI message in bytes. A process that cannot allocate an inbox receives
/// each message into a buffer of this size and discards it.
constexpr std::size_t max_message_bytes = std::size_t{1} << 20U;

/// A duplicate of a communicator of the application. It is kept until MPI_Finalize, because
/// MPI_Comm_free is collective, and processes destroy their Communicators at different times: in
/// Python at garbage collection, or after MPI_Finalize.
struct Duplicate {
    MPI_Comm comm = MPI_COMM_NULL;
    std::uint64_t number = 0;  ///< identifies it on all of its processes
    bool is_used = false;      ///< by a Communicator of this process
};

struct Communicator::Mpi {
    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0;
    int size = 1;
    std::vector<int> every_rank;
    // For a process that is out of memory: a buffer for discarded data, and requests of empty
    // messages.
    std::unique_ptr<std::byte[]> discard_buffer{new std::byte[max_message_bytes]};
    std::unique_ptr<MPI_Request[]> requests;
    mutable bool is_in_transaction = false;  ///< on all processes
    mutable std::optional<int> failed_rank;  ///< the lowest rank that has ended the transaction
    mutable unsigned sparse_exchanges = 0;   ///< number of exchanges so far

    /// Allocates all memory of the group. Not collective.
    explicit Mpi(MPI_Comm original);
    /// Calls no MPI function.
    ~Mpi();
    Mpi(const Mpi&) = delete;
    Mpi& operator=(const Mpi&) = delete;
    Mpi(Mpi&&) = delete;
    Mpi& operator=(Mpi&&) = delete;

    /// Collective in `original`. Assigns a duplicate of `original` to `group`: one that is in use
    /// on no process, if there is any. A process without memory passes null; the function then
    /// returns false on all processes.
    [[nodiscard]] static bool assign_duplicate(MPI_Comm original, Mpi* group);

private:
    std::list<Duplicate> fresh_;      ///< memory for one new duplicate
    Duplicate* duplicate_ = nullptr;  ///< the duplicate that owns `comm`
};

}  // namespace octetra::distributed
