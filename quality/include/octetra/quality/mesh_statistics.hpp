#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

#include <octetra/quality/histogram.hpp>

/// What `octetra info` tells of a mesh.
namespace octetra::quality {

/// How many there are. Edges and faces are those of the cells, each counted once.
struct EntityCounts {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;
    std::size_t cells = 0;
    std::size_t boundary_faces = 0;     ///< faces of exactly one cell
    std::size_t nonmanifold_faces = 0;  ///< faces of more than two cells
    std::size_t tagged_facets = 0;
    std::size_t tagged_edges = 0;
    std::size_t unused_vertices = 0;  ///< vertices of no cell
    /// Sets of cells that hang together; sharing one vertex is enough.
    std::size_t components = 0;
    /// Vertices - edges + faces - cells, without the unused vertices: 1 for a ball.
    std::int64_t euler_characteristic = 0;

    friend bool operator==(const EntityCounts&, const EntityCounts&) = default;
};

/// The cells of one region tag and their volume, or the tagged facets of one marker and their area,
/// or the tagged edges and their length.
struct TagTotal {
    Marker tag = 0;
    std::size_t count = 0;
    double size = 0;

    friend bool operator==(const TagTotal&, const TagTotal&) = default;
};

/// The mean ratio eta of the cells; see mean_ratio.
struct Quality {
    double min = 0;
    double mean = 0;
    double max = 0;

    friend bool operator==(const Quality&, const Quality&) = default;
};

/// Means are over the edges and vertices that cells have: an unused vertex does not lower them.
struct Adjacency {
    double cells_per_edge = 0;
    double cells_per_vertex = 0;
    double edges_per_vertex = 0;
    double faces_per_edge = 0;
    std::size_t max_cells_at_edge = 0;
    std::size_t max_cells_at_vertex = 0;

    friend bool operator==(const Adjacency&, const Adjacency&) = default;
};

/// Lengths, areas and volumes are in the mesh's units, angles in degrees. What is optional is
/// absent exactly where the mesh has no cells. Sums and means are compensated (CompensatedSum), so
/// they are as good as the terms however many there are.
struct MeshStatistics {
    EntityCounts counts;
    std::optional<Box> bounding_box;  ///< of the vertices that cells have

    double volume = 0;                    ///< of all cells, the sum of absolute values
    std::vector<TagTotal> regions;        ///< ascending by tag; empty where the mesh has no tags
    double boundary_area = 0;             ///< of the boundary faces, tagged or not
    std::vector<TagTotal> facet_markers;  ///< likewise; of the tagged facets only
    std::vector<TagTotal> edge_markers;   ///< likewise; of the tagged edges only

    std::optional<Range> edge_length;
    std::optional<Range> cell_volume;
    std::optional<Range> face_angle;           ///< the three of every face
    std::optional<Range> dihedral_angle;       ///< the six of every cell
    Histogram dihedral_histogram{0, 180, 18};  ///< of the same
    std::optional<Quality> eta;
    Histogram eta_histogram{0, 1, 10};

    std::optional<Adjacency> adjacency;

    FeatureCounts features;  ///< how many corners and ridges, and what is required
};

/// Needs vertex numbers in range and nothing else of the invariants of struct Mesh. Memory beside
/// the mesh: at most 32 bytes per cell and 8 per vertex. Time: about that of sorting the faces.
[[nodiscard]] MeshStatistics measure(const Mesh& mesh);

}  // namespace octetra::quality
