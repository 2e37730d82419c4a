#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/index.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// A number that holds on all processes: of a vertex in the canonical order.
enum class GlobalVertex : std::uint64_t {};

/// Where entities of a level come from: the descendants of an entity of the input, its root, stand
/// together, in the order of bisection, and roots in the order of the input. So what a root has
/// (its number, its region tag or marker) need not be kept for each descendant.
struct AncestorMap {
    /// Numbers in the input of this process's roots, ascending.
    std::vector<std::uint64_t> roots;
    /// The descendants of root number r of this process are first[r] .. first[r+1]-1.
    std::vector<std::uint32_t> first{0};
    /// The region tag or marker of each root, or empty where the input has none.
    std::vector<Marker> markers;
};

/// What this process shares with another one. Both have the same edges and faces listed in the same
/// order, and the vertices of each in the same order, so that a position in the list means the same
/// on both sides. Vertices are numbered locally.
struct Interface {
    int rank = 0;
    std::vector<EdgeVertices> edges;
    std::vector<FacetVertices> faces;
};

/// How the midpoint of an edge would be marked by what this process knows of the edge.
struct MidpointMarker {
    enum class Source : std::uint8_t { nothing, facet, edge };
    Source source = Source::nothing;
    Marker marker = 0;
};

/// What the engine keeps from one level to the next where few cells change.
struct Adjacency;
struct DeleteAdjacency {
    void operator()(Adjacency* adjacency) const;
};

/// A mesh of which each process of a group holds some cells, and what belongs to them.
///
/// Vertices are numbered locally, in ascending canonical order: first those of the input, then the
/// midpoints of each level. Cells and what is tagged are in canonical order as well, as far as this
/// process has them, unless the mesh is unordered: see restore_canonical_order().
struct DistributedMesh {
    Communicator processes;

    IndexVector<VertexIndex, Point> points;
    std::size_t attributes_per_point = 0;
    std::vector<double> point_attributes;

    /// The vertices of the input come first; this is what the input numbers them.
    std::vector<GlobalVertex> input_vertices;
    /// Their markers, or empty where the input has none.
    std::vector<Marker> input_vertex_markers;
    /// Local numbers of the first midpoint of each level so far.
    std::vector<VertexIndex> level_begin;
    /// The ends of the edge that a midpoint halves, lower first. Midpoint 0 is the vertex after the
    /// last of the input.
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
        interfaces;  ///< one for each process that shares an edge; rank ascending

    /// The engine's own. While there is one, the mesh is unordered.
    std::unique_ptr<Adjacency, DeleteAdjacency> adjacency;

    // The same on all processes:
    std::uint64_t input_vertex_count = 0;
    std::uint64_t input_cell_count = 0;
    std::uint32_t index_base = 0;
    SharedGroupNames group_names;

    /// Features of the input, if it has any: all processes have lists then, or none has. Each has
    /// some of the numbers, whoever has the entities: what becomes of these is found out when the
    /// mesh is written, as their pieces stand together then.
    SharedFeatures features;
};

/// Collective. Gives each cell of a mesh that the first process has to the process that
/// `cell_to_rank` names; tagged facets and edges go to the process of the first cell that has them.
/// The other processes' mesh and cell_to_rank are not looked at. A group of one process takes the
/// mesh over as it is. Throws InputError, on all, where cell_to_rank has not one rank for each
/// cell.
[[nodiscard]] DistributedMesh distribute(const Communicator& processes, Mesh mesh,
                                         const std::vector<int>& cell_to_rank);

/// Brings cells and tagged facets and edges into canonical order, and their lineages up to date.
/// Refinement leaves a process's mesh unordered where few of its cells were bisected: these stand
/// there in no order, and lineages are not to be looked at. Takes time and memory in proportion to
/// the process's part, and what refinement has kept is lost. Whatever collects or writes a mesh
/// does this. Not collective.
void restore_canonical_order(DistributedMesh& mesh);

/// What collect() puts together again.
struct Collected {
    Mesh mesh;
    RefinementMaps maps;
};

/// Collective. The first process gets the whole mesh in its canonical order, the others an empty
/// one. Throws InputError on all processes where 32 bits cannot number it.
[[nodiscard]] Collected collect(DistributedMesh mesh);

/// Collective. The same, of a mesh that stays as it is.
[[nodiscard]] Collected collect_copy(const DistributedMesh& mesh);

}  // namespace octetra::distributed
