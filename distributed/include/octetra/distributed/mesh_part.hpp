#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The part of one process of a mesh that the calling program has distributed itself. Vertices are
/// denoted by their global numbers, 0 .. n-1, each of which at least one process lists. A list that
/// is described as "or empty" is empty on all processes that have entities of the kind, or on none.
struct MeshPart {
    /// The vertices that this process knows, in any order: all vertices of its cells, and possibly
    /// others. Processes that list the same vertex must agree on its properties.
    std::vector<std::uint64_t> vertex_numbers;
    std::vector<Point> points;          ///< coordinates of these vertices
    std::vector<Marker> point_markers;  ///< or empty
    std::size_t attributes_per_point = 0;
    std::vector<double> point_attributes;  ///< attributes_per_point for each vertex

    /// Each cell of the whole mesh is on exactly one process.
    std::vector<std::array<std::uint64_t, 4>> cells;
    std::vector<Marker> regions;  ///< or empty
    /// Global numbers of the cells, 0 .. n-1 over all processes, ascending on each; or empty on all
    /// processes: cells are then numbered rank by rank, in the order of the lists.
    std::vector<std::uint64_t> cell_numbers;

    /// Tagged facets and edges, each of a cell of this process. Several processes may list the same
    /// one, with the same marker; the lowest rank keeps it. Numbers are as those of cells; if they
    /// are empty on all processes, entities are numbered rank by rank.
    std::vector<std::array<std::uint64_t, 3>> facets;
    std::vector<Marker> facet_markers;  ///< or empty
    std::vector<std::uint64_t> facet_numbers;
    std::vector<std::array<std::uint64_t, 2>> edges;
    std::vector<Marker> edge_markers;  ///< or empty
    std::vector<std::uint64_t> edge_numbers;

    std::uint32_t index_base = 0;        ///< the number of the first vertex in files: 0 or 1
    std::vector<GroupName> group_names;  ///< for files; the same on all processes
};

/// Collective. Returns the parts as one distributed mesh; cells stay on their processes and keep
/// their order. Vertices are numbered by ascending global number, without those that no cell of
/// this process has.
///
/// Throws InputError on all processes, with the rank in the message, if the lengths of lists are
/// inconsistent, numbers are missing or duplicate, a coordinate is not finite or too large, a cell
/// is flat or inverted or has the vertices of another cell of the process, a facet or edge belongs
/// to no cell of the process, or processes contradict each other, also in markers and attributes of
/// vertices. Not checked, but left to verification: cells that two processes both have, and
/// overlapping cells.
[[nodiscard]] DistributedMesh distribute_parts(const Communicator& processes, MeshPart part);

}  // namespace octetra::distributed
