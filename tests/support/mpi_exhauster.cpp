/// To be preloaded (LD_PRELOAD) into a program under mpirun: at reduction number
/// OCTETRA_EXHAUST_AT, from 1, all ranks run out of memory at nearly the same time. Wraps MPI
/// through the profiling interface, PMPI.

#include <mpi.h>

#include <cstdlib>
#include <new>

int MPI_Allreduce(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
    static int calls = 0;
    const char* const at = std::getenv("OCTETRA_EXHAUST_AT");
    if (at != nullptr && ++calls == std::atoi(at)) {
        PMPI_Barrier(comm);
        throw std::bad_alloc();
    }
    return PMPI_Allreduce(mine, result, count, type, operation, comm);
}
