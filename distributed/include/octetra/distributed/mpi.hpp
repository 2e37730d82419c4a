#pragma once

#include <mpi.h>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Collective. Returns a Communicator with the processes of an MPI communicator, for programs that
/// have initialised MPI. Messages use a duplicate of `comm`, so that they cannot be confused with
/// those of the program.
///
/// A duplicate is never freed before MPI_Finalize: MPI_Comm_free is collective, while Communicators
/// and meshes may be destroyed at any time, in a different order on each process, for instance by
/// the garbage collection of Python, or after MPI_Finalize. A duplicate that no process uses any
/// more is reused by the next call for the same processes in the same order, so the number of
/// duplicates is the largest number in use at the same time. `comm` itself may be freed after the
/// return.
///
/// Throws InputError if `comm` is an intercommunicator or MPI_COMM_NULL, and std::bad_alloc on all
/// processes if one runs out of memory.
[[nodiscard]] Communicator communicator_of(MPI_Comm comm);

/// The inverse of communicator_of(): returns an MPI communicator with these processes, in their
/// order; MPI_COMM_SELF if this process has never called MPI. It belongs to `processes`: duplicate
/// it to send messages.
[[nodiscard]] MPI_Comm comm_of(const Communicator& processes);

}  // namespace octetra::distributed
