#pragma once

#include <mpi.h>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// For programs that have MPI running: the processes of an MPI communicator. Collective. Messages
/// go through a duplicate of the communicator, so that none meets one of the program's.
///
/// No duplicate is ever freed before MPI_Finalize. MPI_Comm_free is collective, while Communicators
/// and meshes may be destroyed at any time: at another one on each process, as by Python's garbage
/// collection, or after MPI_Finalize. A duplicate that no process uses any more serves the next
/// call for the same processes, in the same order. So there are as many duplicates for them as were
/// used at the same time, and `comm` itself may be freed when this returns.
///
/// Throws InputError where `comm` is an intercommunicator or MPI_COMM_NULL; std::bad_alloc, on all
/// processes, where one has no memory.
[[nodiscard]] Communicator communicator_of(MPI_Comm comm);

/// The other way: a communicator of MPI with these processes, in their order; MPI_COMM_SELF of a
/// process that never called MPI. It is theirs: to send messages, duplicate it.
[[nodiscard]] MPI_Comm comm_of(const Communicator& processes);

}  // namespace octetra::distributed
