#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// What one process has of a mesh that a program has distributed itself. Vertices go by their
/// numbers in the whole mesh, 0 .. n-1, each of which some process lists. A list with the remark
/// "or empty" is empty on all processes that have entities of the kind, or on none.
struct MeshPart {
    /// The vertices that this process knows, in any order: all those of its cells, and others if it
    /// likes. What several processes say of a vertex is the same.
    std::vector<std::uint64_t> vertex_numbers;
    std::vector<Point> points;
    std::vector<Marker> point_markers;  ///< or empty
    std::size_t attributes_per_point = 0;
    std::vector<double> point_attributes;  ///< attributes_per_point for each vertex

    /// Every cell of the whole mesh is on one process, once.
    std::vector<std::array<std::uint64_t, 4>> cells;
    std::vector<Marker> regions;  ///< or empty
    /// Numbers of the cells in the whole mesh, 0 .. n-1 over all processes, ascending on each; or
    /// empty on all: the first process's cells come first, then the second's, as they stand.
    std::vector<std::uint64_t> cell_numbers;

    /// Tagged facets and edges, each of a cell of this process. More than one process may list the
    /// same one, with the same marker; the lowest rank keeps it. Numbers are as those of cells; or
    /// empty on all: they are numbered in the order of the ranks.
    std::vector<std::array<std::uint64_t, 3>> facets;
    std::vector<Marker> facet_markers;  ///< or empty
    std::vector<std::uint64_t> facet_numbers;
    std::vector<std::array<std::uint64_t, 2>> edges;
    std::vector<Marker> edge_markers;  ///< or empty
    std::vector<std::uint64_t> edge_numbers;

    std::uint32_t index_base = 0;        ///< what files are to call the first vertex: 0 or 1
    std::vector<GroupName> group_names;  ///< for files; the same on all processes
};

/// Collective. The parts as one distributed mesh; cells stay where they are, and as they stand.
/// Vertices are numbered by ascending global number, without those that only other processes use.
///
/// Throws InputError on all processes where lists do not fit each other, numbers are missing or
/// there twice, a coordinate is not finite or too large, a cell is flat or inverted or has the
/// vertices of another one of the process, a facet or edge is of no cell of the process, or
/// processes contradict each other, also in markers and attributes of vertices; the message names
/// the rank. Not checked: whether two processes have the same cell, or cells overlap, which
/// verification does.
[[nodiscard]] DistributedMesh distribute_parts(const Communicator& processes, MeshPart part);

}  // namespace octetra::distributed
