#pragma once

#include <petscdmplex.h>

#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/petsc/to_plex.hpp>

namespace octetra::petsc {

/// A mesh created from a plex, and the plex points of its cells and vertices. The points are valid
/// until the mesh is modified; an Adaptation and a Migration can be used to transfer them.
struct MeshFromPlex {
    distributed::AdaptiveMesh mesh;
    std::vector<PetscInt> cell_points;    ///< of each cell of this process
    std::vector<PetscInt> vertex_points;  ///< of each vertex; -1 if not in this process's plex
};

/// Collective. Creates a mesh from the cells of a plex, which must be tetrahedra in three
/// dimensions, with labels as tags; cells without a label have region tag 0. Cells stay on their
/// processes; cells of an overlap are taken on the process that owns them. Faces and edges can have
/// labels only if the plex has faces and edges (DMPlexInterpolate()). The orientation of cells does
/// not matter.
///
/// Throws the same error on all processes: InputError if PETSc is not initialised, the plex is of
/// another kind, or AdaptiveMesh::from_parts() rejects its parts; OutOfMemory if memory is
/// exhausted on any.
[[nodiscard]] MeshFromPlex from_plex(DM plex, const PlexLabels& labels = {});

}  // namespace octetra::petsc
