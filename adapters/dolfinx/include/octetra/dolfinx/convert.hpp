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

/// Conversions between meshes of DOLFINx and Octetra. Every rank converts its own part: cells stay
/// on their ranks, and nothing is gathered.
namespace octetra::dolfinx {

using MarkerTags = ::dolfinx::mesh::MeshTags<Marker>;

/// A DOLFINx mesh, and the cells and vertices of the AdaptiveMesh, at the time of conversion, that
/// correspond to its cells and nodes.
struct Handover {
    std::shared_ptr<const ::dolfinx::mesh::Mesh> mesh;
    /// Region tags of cells and markers of facets; absent if the mesh has none.
    std::optional<MarkerTags> cell_tags;
    std::optional<MarkerTags> facet_tags;
    /// For each DOLFINx cell owned by this rank, the cell of the AdaptiveMesh.
    std::vector<CellIndex> cells;
    /// For each node of the DOLFINx geometry on this rank, the vertex of the AdaptiveMesh; none()
    /// for nodes that belong only to ghost cells.
    std::vector<VertexIndex> vertices;
};

struct HandoverOptions {
    /// The ghost cells of each rank, or none. Integrals over interior facets need ghosts by faces.
    std::optional<distributed::GhostsBy> ghosts = distributed::GhostsBy::face;
    /// Whether to convert tags. Tags of facets require that DOLFINx numbers all facets, which takes
    /// longer than the rest of the conversion.
    bool tags = true;
};

/// Collective. Converts the mesh for DOLFINx, on the same communicator. Cells keep their numbers;
/// vertices owned by a rank come first, in their order, and node i and vertex i of DOLFINx are the
/// same. The geometry's input_global_indices() are the mesh's vertex_numbers(). A tagged facet is
/// tagged on all ranks that have it.
///
/// Throws InputError on all ranks if any of them has more entities than DOLFINx can number with 32
/// bits.
[[nodiscard]] Handover to_mesh(const distributed::AdaptiveMesh& mesh,
                               const HandoverOptions& options = {});

/// Collective. Converts a DOLFINx mesh into an AdaptiveMesh, on the same communicator. The mesh
/// must consist of affine, non-flat tetrahedra in three dimensions; inverted cells are reversed.
/// `cell_tags` become region tags, 0 for cells without a tag, and `facet_tags` tagged facets with
/// markers. Null, for none, must be passed on all ranks or on none. Only the dimension and range of
/// tags are checked.
///
/// Vertices and cells are numbered as at the creation of the DOLFINx mesh, if it has this
/// information for all of them; files then do not depend on the number of ranks. Otherwise the
/// current DOLFINx numbering is used.
///
/// Throws InputError on all ranks if the mesh or tags do not satisfy these conditions.
[[nodiscard]] std::pair<distributed::AdaptiveMesh, Handover> from_mesh(
    std::shared_ptr<const ::dolfinx::mesh::Mesh> mesh, const MarkerTags* cell_tags = nullptr,
    const MarkerTags* facet_tags = nullptr);

}  // namespace octetra::dolfinx
