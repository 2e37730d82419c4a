#pragma once

#include <petscdmplex.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/petsc/to_plex.hpp>

namespace octetra::petsc {

/// Not collective. Gives a new plex its points, with the cones of cells (faces), faces (edges) and
/// edges (vertices). Faces and edges have their vertices in ascending order, the same on all
/// processes that share them.
void set_cones(DM plex, const PlexPoints& points, const distributed::AdaptiveMesh& mesh,
               const distributed::MeshFaces& faces, const distributed::MeshEdges& edges);

}  // namespace octetra::petsc
