#pragma once

#include <petscmat.h>

#include <vector>

#include <octetra/distributed/levels.hpp>

namespace octetra::petsc {

/// Collective. Returns, for each level but the last, the matrix that interpolates values of P1
/// elements to the next level (Levels::prolongation()), for PCMGSetInterpolation(). Rows and
/// columns have the layout of vectors in the order of the levels' index maps (make_index_map()):
/// those of vertices that a process owns are on that process.
///
/// `comm` must have the processes of the mesh in the same order. The caller destroys the matrices
/// with MatDestroy().
///
/// Throws the same error on all processes: InputError if PETSc is not initialised, `comm` is a
/// different group, or the numbers are too large for PetscInt; OutOfMemory if memory is exhausted
/// on any.
[[nodiscard]] std::vector<Mat> interpolations(const distributed::Levels& levels,
                                              MPI_Comm comm = PETSC_COMM_WORLD);

}  // namespace octetra::petsc
