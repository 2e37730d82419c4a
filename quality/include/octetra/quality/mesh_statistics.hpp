#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <octetra/core/features.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>

#include <octetra/quality/histogram.hpp>

/// The statistics printed by `octetra info`.
namespace octetra::quality {

/// Numbers of entities. Edges and faces are those of the cells, each counted once.
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
    /// Sets of connected cells; a common vertex is sufficient.
    std::size_t components = 0;
    /// Vertices - edges + faces - cells, without the unused vertices: 1 for a ball.
    std::int64_t euler_characteristic = 0;

    friend bool operator==(const EntityCounts&, const EntityCounts&) = default;
};

/// The cells with a region tag and their volume, or the tagged facets with a marker and their area,
/// or the tagged edges with a marker and their length.
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

/// Means are over the edges and vertices of cells; unused vertices are not counted.
struct Adjacency {
    double cells_per_edge = 0;
    double cells_per_vertex = 0;
    double edges_per_vertex = 0;
    double faces_per_edge = 0;
    std::size_t max_cells_at_edge = 0;
    std::size_t max_cells_at_vertex = 0;

    friend bool operator==(const Adjacency&, const Adjacency&) = default;
};

/// Lengths, areas and volumes are in the mesh's units, angles in degrees. Optional members are
/// absent if and only if the mesh has no cells. Sums and means are compensated (CompensatedSum), so
/// their accuracy does not depend on the number of terms.
struct MeshStatistics {
    EntityCounts counts;
    std::optional<Box> bounding_box;  ///< of the vertices of cells

    double volume = 0;                    ///< of all cells, the sum of absolute values
    std::vector<TagTotal> regions;        ///< ascending by tag; empty if the mesh has no tags
    double boundary_area = 0;             ///< of the boundary faces, tagged or not
    std::vector<TagTotal> facet_markers;  ///< likewise; of the tagged facets only
    std::vector<TagTotal> edge_markers;   ///< likewise; of the tagged edges only

    std::optional<Range> edge_length;
    std::optional<Range> cell_volume;
    std::optional<Range> face_angle;           ///< three angles of every face
    std::optional<Range> dihedral_angle;       ///< six angles of every cell
    Histogram dihedral_histogram{0, 180, 18};  ///< of the dihedral angles
    std::optional<Quality> eta;
    Histogram eta_histogram{0, 1, 10};

    std::optional<Adjacency> adjacency;

    FeatureCounts features;  ///< numbers of corners, ridges and required entities
};

/// Computes the statistics of a mesh. Requires only that vertex numbers are in range. Memory in
/// addition to the mesh: at most 32 bytes per cell and 8 per vertex. Time: about that of sorting
/// the faces.
[[nodiscard]] MeshStatistics measure(const Mesh& mesh);

}  // namespace octetra::quality
