#include "check_petsc.hpp"

#include <new>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/petsc/versions.hpp>

namespace octetra::petsc {

void check(PetscErrorCode code) {
    if (code == 0) return;
    if (code == PETSC_ERR_MEM) throw std::bad_alloc();
    const char* kind = nullptr;
    const char* words = nullptr;
    (void)error_message(code, &kind, &words);
    throw SystemError(fmt::format("PETSc: {} ({})", words == nullptr ? "" : words,
                                  kind == nullptr ? "unknown error" : kind));
}

void check_initialised() {
    PetscBool is_initialised = PETSC_FALSE;
    (void)PetscInitialized(&is_initialised);
    if (is_initialised == PETSC_FALSE) {
        throw InputError("PETSc is not initialised: call PetscInitialize() first");
    }
}

void check_group(const distributed::Communicator& processes, MPI_Comm comm) {
    check_initialised();
    int rank = 0;
    int size = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    if (rank != processes.rank() || size != processes.size()) {
        throw InputError(
            fmt::format("rank {} of {} of the mesh is rank {} of {} of the communicator",
                        processes.rank(), processes.size(), rank, size));
    }
}

}  // namespace octetra::petsc
