#pragma once

#include <mpi.h>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// For programs that have MPI running: the processes of an MPI communicator. Collective; duplicates
/// the communicator, so that no message of ours meets one of theirs. Throws InputError where it is
/// an intercommunicator or MPI_COMM_NULL.
[[nodiscard]] Communicator communicator_of(MPI_Comm comm);

/// The other way: a communicator of MPI with these processes, in their order; MPI_COMM_SELF of a
/// process that never called MPI. It is theirs: to send messages, duplicate it.
[[nodiscard]] MPI_Comm comm_of(const Communicator& processes);

}  // namespace octetra::distributed
