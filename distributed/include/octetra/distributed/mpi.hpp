#pragma once

#include <mpi.h>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// For programs that have MPI running: the processes of an MPI communicator. Collective; duplicates
/// the communicator, so that no message of ours meets one of theirs.
[[nodiscard]] Communicator communicator_of(MPI_Comm comm);

}  // namespace octetra::distributed
