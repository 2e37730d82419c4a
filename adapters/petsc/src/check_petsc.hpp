#pragma once

#include <petscsys.h>

namespace octetra::petsc {

/// Throws what a function of PETSc returns, if it is an error: std::bad_alloc or SystemError.
void check(PetscErrorCode code);

/// Throws InputError unless PETSc is there to be used.
void check_initialised();

/// While it lives, PETSc returns errors and prints nothing.
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
