#pragma once

#include <petscdmplex.h>

/// Functions of PETSc whose parameters differ between its versions 3.18 to 3.26. They return the
/// error code of PETSc.
namespace octetra::petsc {

/// DMPlexSetSNESLocalFEM() for a problem whose functions have no context.
[[nodiscard]] inline PetscErrorCode set_snes_local_fem(DM plex) {
#if PETSC_VERSION_GE(3, 21, 0)
    return DMPlexSetSNESLocalFEM(plex, PETSC_FALSE, nullptr);
#else
    return DMPlexSetSNESLocalFEM(plex, nullptr, nullptr, nullptr);
#endif
}

/// DMPlexCreateBoxMesh(): the unit square or cube with its faces and edges, and PETSc's default
/// number of cells.
[[nodiscard]] inline PetscErrorCode create_box_mesh(MPI_Comm comm, PetscInt dimension,
                                                    PetscBool of_simplices, DM* made) {
#if PETSC_VERSION_GE(3, 22, 0)
    return DMPlexCreateBoxMesh(comm, dimension, of_simplices, nullptr, nullptr, nullptr, nullptr,
                               PETSC_TRUE, 0, PETSC_FALSE, made);
#else
    return DMPlexCreateBoxMesh(comm, dimension, of_simplices, nullptr, nullptr, nullptr, nullptr,
                               PETSC_TRUE, made);
#endif
}

/// PetscErrorMessage(): the kind of an error and its text; null if there is none.
[[nodiscard]] inline PetscErrorCode error_message(PetscErrorCode code, const char** kind,
                                                  const char** text) {
#if PETSC_VERSION_GE(3, 25, 0)
    return PetscErrorMessage(code, kind, text);
#else
    char* own = nullptr;
    const PetscErrorCode status = PetscErrorMessage(code, kind, &own);
    *text = own;
    return status;
#endif
}

}  // namespace octetra::petsc
