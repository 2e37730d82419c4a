#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/core/features.hpp>
#include <octetra/core/index.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The number of a vertex in the canonical order of the whole mesh, the same on all processes.
enum class GlobalVertex : std::uint64_t {};

/// The ancestor map of this process's entities of one kind. The descendants of an entity of the
/// input, its root, are contiguous, in the order of bisection, and roots are in the order of the
/// input. So the properties of a root (its number, its region tag or marker) need not be stored for
/// each descendant.
struct AncestorMap {
    /// The numbers in the input of this process's roots, ascending.
    std::vector<std::uint64_t> roots;
    /// The descendants of this process's root number r are first[r] .. first[r+1]-1.
    std::vector<std::uint32_t> first{0};
    /// The region tag or marker of each root, or empty where the input has none.
    std::vector<Marker> markers;
};

/// The edges and faces that this process shares with another one. Both list the same edges and
/// faces in the same order, and the vertices of each in the same order, so that a position in the
/// list denotes the same entity on both sides. Vertices are local numbers.
struct Interface {
    int rank = 0;
    std::vector<EdgeVertices> edges;
    std::vector<FacetVertices> faces;
};

/// The marker of an edge's midpoint, as far as this process knows the edge.
struct MidpointMarker {
    enum class Source : std::uint8_t { nothing, facet, edge };
    Source source = Source::nothing;
    Marker marker = 0;
};

/// Data that the engine keeps from one level to the next while few cells change.
struct Adjacency;
struct DeleteAdjacency {
    void operator()(Adjacency* adjacency) const;
};

/// The part of this process of a mesh that is distributed over the processes of a communicator.
///
/// Vertices have local numbers, in ascending canonical order: first the vertices of the input, then
/// the midpoints of each level. Cells and tagged facets and edges are in canonical order as well,
/// unless the mesh is unordered: see restore_canonical_order().
struct DistributedMesh {
    Communicator processes;

    IndexVector<VertexIndex, Point> points;
    std::size_t attributes_per_point = 0;
    std::vector<double> point_attributes;

    /// The numbers in the input of the vertices of the input, which are the first local vertices.
    std::vector<GlobalVertex> input_vertices;
    /// Their markers, or empty where the input has none.
    std::vector<Marker> input_vertex_markers;
    /// The local number of the first midpoint of each level so far.
    std::vector<VertexIndex> level_begin;
    /// The ends of the edge that a midpoint halves, lower first. Midpoint 0 is the vertex that
    /// follows the last vertex of the input.
    std::vector<EdgeVertices> midpoint_to_edge;
    /// One for each midpoint, or empty where the input has no vertex markers.
    std::vector<MidpointMarker> midpoint_markers;

    IndexVector<CellIndex, CellVertices> cells;
    AncestorMap cell_ancestors;  ///< markers: region tags
    IndexVector<FacetIndex, FacetVertices> facets;
    AncestorMap facet_ancestors;
    IndexVector<EdgeIndex, EdgeVertices> edges;  ///< tagged edges
    AncestorMap edge_ancestors;

    std::vector<Interface>
        interfaces;  ///< one for each process that shares an edge; ascending by rank

    /// Internal to the engine. While it is not null, the mesh is unordered.
    std::unique_ptr<Adjacency, DeleteAdjacency> adjacency;

    // The same on all processes:
    std::uint64_t input_vertex_count = 0;
    std::uint64_t input_cell_count = 0;
    std::uint32_t index_base = 0;
    SharedGroupNames group_names;
    /// The closure of all levels so far, if there are any.
    Closure closure = Closure::longest_edge;

    /// The features of the input, if it has any: either all processes have these lists or none has.
    /// Each process has those of a share of the numbers, whatever parts the entities belong to;
    /// features of descendants are determined when the mesh is written.
    SharedFeatures features;
};

/// Collective. Distributes a mesh that the first process holds: cell i goes to rank
/// cell_to_rank[i], and each tagged facet or edge to the rank of the first cell that has it. The
/// arguments of the other processes are ignored. A group of one process takes the mesh over as it
/// is. Throws InputError on all processes if cell_to_rank does not have one valid rank for each
/// cell.
[[nodiscard]] DistributedMesh distribute(const Communicator& processes, Mesh mesh,
                                         const std::vector<int>& cell_to_rank);

/// Restores the canonical order of cells and tagged facets and edges, and the ancestor maps.
/// Refinement leaves the part of a process unordered if few of its cells were bisected: the order
/// of these entities is then unspecified, and the ancestor maps must not be used. Takes time and
/// memory proportional to the part, and discards the data kept for incremental levels. All
/// functions that collect or write a mesh call this. Not collective.
void restore_canonical_order(DistributedMesh& mesh);

/// The result of collect().
struct Collected {
    Mesh mesh;
    RefinementMaps maps;
};

/// Collective. Returns the whole mesh in canonical order on the first process, and an empty mesh on
/// the others. Throws InputError on all processes if its entities cannot be numbered with 32 bits.
[[nodiscard]] Collected collect(DistributedMesh mesh);

/// Collective. The same for a mesh that is kept.
[[nodiscard]] Collected collect_copy(const DistributedMesh& mesh);

}  // namespace octetra::distributed
