#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <dolfinx/mesh/Mesh.h>
#include <dolfinx/mesh/MeshTags.h>

#include <octetra/core/index.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/ghosts.hpp>

/// Meshes of DOLFINx and of Octetra, the one made of the other. Every rank hands over its own part:
/// no cell changes its rank, and none is gathered anywhere.
namespace octetra::dolfinx {

using MarkerTags = ::dolfinx::mesh::MeshTags<Marker>;

/// A mesh of DOLFINx, and what its cells and nodes are in the AdaptiveMesh, as that was at the
/// time.
struct Handover {
    std::shared_ptr<const ::dolfinx::mesh::Mesh> mesh;
    /// Region tags of cells and markers of facets; none where the mesh has none.
    std::optional<MarkerTags> cell_tags;
    std::optional<MarkerTags> facet_tags;
    /// Of each DOLFINx cell that this rank owns, the AdaptiveMesh's.
    std::vector<CellIndex> cells;
    /// Of each node of the DOLFINx geometry on this rank, the AdaptiveMesh's vertex; none of nodes
    /// that only ghost cells have.
    std::vector<VertexIndex> vertices;
};

struct HandoverOptions {
    /// Which cells of other ranks each rank is to have as ghosts, or none. Integrals over interior
    /// facets take those by faces.
    std::optional<distributed::GhostsBy> ghosts = distributed::GhostsBy::face;
    /// Hand tags over, too? Those of facets make DOLFINx number all facets, which takes longer than
    /// all else.
    bool tags = true;
};

/// Collective. The mesh for DOLFINx, on the same communicator. Cells keep their numbers; a rank's
/// own vertices come first, in their order, and node and vertex i of DOLFINx are the same. The
/// geometry's input_global_indices() are the mesh's vertex_numbers(). A tagged facet is tagged on
/// all ranks that have it.
///
/// Throws InputError on all ranks where one has more than DOLFINx's 32 bits can number.
[[nodiscard]] Handover to_mesh(const distributed::AdaptiveMesh& mesh,
                               const HandoverOptions& options = {});

/// Collective. A mesh of DOLFINx as an AdaptiveMesh, on the same communicator: of affine tetrahedra
/// in three dimensions, none of them flat; inverted ones are turned round. Cells become regions by
/// `cell_tags`, 0 where they have none, and the tagged facets come along with their markers. Null:
/// none; the same on all ranks. The tags are not checked beyond their dimension and range.
///
/// Vertices and cells are numbered as they were when the DOLFINx mesh was created, if it still
/// tells that of all: then files do not depend on the number of ranks. Else as DOLFINx numbers them
/// now.
///
/// Throws InputError on all ranks where the mesh or tags are not as said.
[[nodiscard]] std::pair<distributed::AdaptiveMesh, Handover> from_mesh(
    std::shared_ptr<const ::dolfinx::mesh::Mesh> mesh, const MarkerTags* cell_tags = nullptr,
    const MarkerTags* facet_tags = nullptr);

}  // namespace octetra::dolfinx
