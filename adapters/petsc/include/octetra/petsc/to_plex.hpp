#pragma once

#include <petscdmplex.h>

#include <string>

#include <octetra/distributed/adaptive_mesh.hpp>

/// Conversion between meshes and DMPlex, the unstructured meshes of PETSc. PETSc must be
/// initialised.
namespace octetra::petsc {

/// The label names of a plex; the defaults for tags are those of meshes read by PETSc. An empty
/// name omits the label. The same on all processes.
struct PlexLabels {
    std::string cells = "Cell Sets";  ///< region tags of cells
    std::string faces = "Face Sets";  ///< markers of tagged facets
    std::string edges = "Edge Sets";  ///< markers of tagged edges
    /// 1 on faces on the boundary of the whole mesh, tagged or not. Ignored by from_plex().
    /// (DMPlexMarkBoundaryFaces() also marks faces between processes before PETSc 3.19.)
    std::string boundary = "boundary";
};

/// The points of a plex created by to_plex(): cells first, then vertices, faces and edges, each
/// kind in the order of the mesh's local numbers; faces and edges as in number_faces() and
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

/// Not collective. Returns the points of this process's part of a plex created by to_plex(). Not
/// valid for distributed or reordered copies of the plex.
[[nodiscard]] PlexPoints points_of(DM plex);

/// Collective. Converts the mesh into a DMPlex with the same distribution: every process creates
/// the cells, vertices, faces and edges of its part, with coordinates and labels. The point SF
/// describes shared points, as known from the mesh's sharers; the root of a point is on the mesh's
/// owner. There is no overlap. Tagged facets and edges are labelled on all processes that have
/// them.
///
/// The vertices of a cell in the plex are those of the mesh with the first two exchanged, because
/// PETSc uses the opposite orientation of tetrahedra.
///
/// `comm` must have the processes of the mesh in the same order. The plex is independent of later
/// changes of the mesh; the caller destroys it with DMDestroy().
///
/// Throws the same error on all processes: InputError if PETSc is not initialised, `comm` is a
/// different group, or a process has too many points for PetscInt; OutOfMemory if memory is
/// exhausted on any.
[[nodiscard]] DM to_plex(const distributed::AdaptiveMesh& mesh, MPI_Comm comm = PETSC_COMM_WORLD,
                         const PlexLabels& labels = {});

}  // namespace octetra::petsc
