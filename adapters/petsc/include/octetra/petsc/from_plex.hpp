#pragma once

#include <petscdmplex.h>

#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/petsc/to_plex.hpp>

namespace octetra::petsc {

/// A mesh that came from a plex, and the points that its cells and vertices were. They hold as long
/// as the mesh is not changed; an Adaptation and a Migration tell of what has become of it.
struct MeshFromPlex {
    distributed::AdaptiveMesh mesh;
    std::vector<PetscInt> cell_points;    ///< of each cell of this process
    std::vector<PetscInt> vertex_points;  ///< of each vertex; -1 if its plex does not have it
};

/// Collective. A mesh of a plex's cells, all tetrahedra of three dimensions, with labels as tags;
/// cells without a label have region tag 0. Cells stay where they are; cells of an overlap count on
/// the process that owns them. Faces and edges have labels only in a plex that has faces and edges
/// (DMPlexInterpolate()). Which way round a cell was does not matter.
///
/// Throws alike on all processes: InputError where PETSc is not initialised, the plex is of another
/// kind, or AdaptiveMesh::from_parts() refuses its parts; OutOfMemory if one has no memory.
[[nodiscard]] MeshFromPlex from_plex(DM plex, const PlexLabels& labels = {});

}  // namespace octetra::petsc
