#pragma once

#include <petscsys.h>

#include <octetra/distributed/communicator.hpp>

namespace octetra::petsc {

/// Throws if the error code of a PETSc function indicates an error: std::bad_alloc or SystemError.
void check(PetscErrorCode code);

/// Throws InputError unless PETSc is initialised.
void check_initialised();

/// Throws InputError unless PETSc is initialised and `comm` has the processes of a mesh in the same
/// order. Not collective.
void check_group(const distributed::Communicator& processes, MPI_Comm comm);

/// During the lifetime of an object, PETSc returns errors without printing.
class SilentErrors {
public:
    SilentErrors() { check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr)); }
    ~SilentErrors() { (void)PetscPopErrorHandler(); }
    SilentErrors(const SilentErrors&) = delete;
    SilentErrors& operator=(const SilentErrors&) = delete;
    SilentErrors(SilentErrors&&) = delete;
    SilentErrors& operator=(SilentErrors&&) = delete;
};

}  // namespace octetra::petsc
