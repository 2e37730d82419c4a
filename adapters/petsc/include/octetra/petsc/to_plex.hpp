#pragma once

#include <petscdmplex.h>

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

/// Meshes to and from DMPlex, the unstructured meshes of PETSc. PETSc must be initialised.
namespace octetra::petsc {

/// The labels of a plex; those that hold tags are called as in meshes that PETSc reads. An empty
/// name leaves its label out. The same on all processes.
struct PlexLabels {
    std::string cells = "Cell Sets";  ///< region tags of cells
    std::string faces = "Face Sets";  ///< markers of tagged facets
    std::string edges = "Edge Sets";  ///< markers of tagged edges
    /// 1 on faces on the boundary of the whole mesh, tagged or not. from_plex() does not look at
    /// it. (DMPlexMarkBoundaryFaces() of PETSc 3.18 also marks faces between processes.)
    std::string boundary = "boundary";
};

/// The points of a plex that to_plex() has made: cells first, then vertices, faces and edges, each
/// kind by the mesh's local numbers; of faces and edges, those of number_faces() and
/// number_edges().
struct PlexPoints {
    PetscInt first_vertex = 0;  ///< the first cell is point 0
    PetscInt first_face = 0;
    PetscInt first_edge = 0;
    PetscInt end = 0;

    [[nodiscard]] static PetscInt of(CellIndex c) { return static_cast<PetscInt>(c.value()); }
    [[nodiscard]] PetscInt of(VertexIndex v) const { return plus(first_vertex, v.value()); }
    [[nodiscard]] PetscInt of(distributed::FaceIndex f) const {
        return plus(first_face, f.value());
    }
    [[nodiscard]] PetscInt of(EdgeIndex e) const { return plus(first_edge, e.value()); }

private:
    [[nodiscard]] static PetscInt plus(PetscInt first, std::uint32_t number) {
        return first + static_cast<PetscInt>(number);
    }
};

/// Not collective. The points of this process's part of a plex that to_plex() has made. Copies of
/// the plex that are distributed or reordered have others.
[[nodiscard]] PlexPoints points_of(DM plex);

/// Collective. The mesh as a DMPlex that is distributed in the same way: every process makes the
/// cells, vertices, faces and edges of its part, with coordinates and labels. The point SF says
/// which are shared, from what the mesh knows of its sharers; a point's root is with the mesh's
/// owner. There is no overlap. Tagged facets and edges are labelled on all processes that have
/// them.
///
/// A cell's vertices in the plex are those of the mesh with the first two exchanged, as PETSc turns
/// tetrahedra the other way round.
///
/// `comm` has the processes of the mesh, in their order. The plex is a picture of the mesh as it
/// is; the caller ends it by DMDestroy().
///
/// Throws alike on all processes: InputError where PETSc is not initialised, `comm` is another
/// group, or a process has too many points for PetscInt; OutOfMemory if one has no memory.
[[nodiscard]] DM to_plex(const distributed::AdaptiveMesh& mesh, MPI_Comm comm = PETSC_COMM_WORLD,
                         const PlexLabels& labels = {});

}  // namespace octetra::petsc
