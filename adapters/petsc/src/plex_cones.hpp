#pragma once

#include <petscdmplex.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/petsc/to_plex.hpp>

namespace octetra::petsc {

/// Not collective. Creates the points of a new plex, with the cones of cells (faces), faces (edges)
/// and edges (vertices). The vertices of faces and edges are in ascending order, the same on all
/// processes that share them.
void set_cones(DM plex, const PlexPoints& points, const distributed::AdaptiveMesh& mesh,
               const distributed::MeshFaces& faces, const distributed::MeshEdges& edges);

}  // namespace octetra::petsc
