#include <octetra/quality/mesh_statistics.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/quality/shape.hpp>

#include "cell_sides.hpp"
#include "compensated_sum.hpp"

namespace octetra::quality {
namespace {

Corners corners_of(const Mesh& mesh, const CellVertices& cell) {
    return {mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
}

Triangle triangle_of(const Mesh& mesh, const FacetVertices& face) {
    return {mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]};
}

/// Counts and sums sizes by tag. Consecutive entities mostly have the same tag, so the last entry
/// used is cached.
class TagTotals {
public:
    void add(Marker tag, double size) {
        if (last_ == totals_.end() || last_->first != tag) last_ = totals_.try_emplace(tag).first;
        ++last_->second.count;
        last_->second.size.add(size);
    }

    [[nodiscard]] std::vector<TagTotal> ascending() const {
        std::vector<TagTotal> out;
        for (const auto& [tag, total] : totals_) {
            out.push_back({tag, total.count, total.size.value()});
        }
        return out;
    }

private:
    struct Total {
        std::size_t count = 0;
        CompensatedSum size;
    };

    std::map<Marker, Total> totals_;
    std::map<Marker, Total>::iterator last_ = totals_.end();
};

/// Disjoint sets of vertices: a forest whose trees are the sets.
class VertexSets {
public:
    explicit VertexSets(std::size_t vertex_count) : parent_(vertex_count) {
        for (VertexIndex v{0}; v < parent_.end_index(); ++v) parent_[v] = v;
    }

    void join(VertexIndex a, VertexIndex b) { parent_[root(a)] = root(b); }

    [[nodiscard]] bool is_root(VertexIndex v) const { return parent_[v] == v; }

private:
    VertexIndex root(VertexIndex v) {
        while (!is_root(v)) {
            parent_[v] = parent_[parent_[v]];  // path halving
            v = parent_[v];
        }
        return v;
    }

    IndexVector<VertexIndex, VertexIndex> parent_;
};

std::size_t count_components(const Mesh& mesh) {
    VertexSets sets(mesh.points.size());
    std::vector<bool> used(mesh.points.size(), false);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) {
            sets.join(v, cell[0]);
            used[v.value()] = true;
        }
    }
    std::size_t count = 0;
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (used[v.value()] && sets.is_root(v)) ++count;
    }
    return count;
}

/// Computes the number of unused vertices, the maximum number of cells at a vertex, and the
/// bounding box of the used vertices.
void measure_vertices(const Mesh& mesh, MeshStatistics& out, Adjacency& adjacency) {
    IndexVector<VertexIndex, std::uint32_t> cells_at(mesh.points.size(), 0);
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex v : cell) ++cells_at[v];
    }
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        if (cells_at[v] == 0) {
            ++out.counts.unused_vertices;
            continue;
        }
        const Point& p = mesh.points[v];
        if (!out.bounding_box) out.bounding_box = Box{p, p};
        auto& [low, high] = *out.bounding_box;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        adjacency.max_cells_at_vertex =
            std::max(adjacency.max_cells_at_vertex, std::size_t{cells_at[v]});
    }
}

void measure_edges(const Mesh& mesh, MeshStatistics& out, Adjacency& adjacency) {
    for_each_side(mesh, cell_edges, [&](const EdgeVertices& edge, std::size_t cells) {
        ++out.counts.edges;
        extend(out.edge_length, distance(mesh.points[edge[0]], mesh.points[edge[1]]));
        adjacency.max_cells_at_edge = std::max(adjacency.max_cells_at_edge, cells);
    });
}

void measure_faces(const Mesh& mesh, MeshStatistics& out) {
    CompensatedSum boundary_area;
    for_each_side(mesh, cell_faces, [&](const FacetVertices& face, std::size_t cells) {
        const Triangle triangle = triangle_of(mesh, face);
        ++out.counts.faces;
        if (cells == 1) {
            ++out.counts.boundary_faces;
            boundary_area.add(area(triangle));
        }
        if (cells > 2) ++out.counts.nonmanifold_faces;
        for (const double angle : corner_angles(triangle)) extend(out.face_angle, angle);
    });
    out.boundary_area = boundary_area.value();
}

void measure_cells(const Mesh& mesh, MeshStatistics& out) {
    CompensatedSum volumes;
    CompensatedSum etas;
    std::optional<Range> eta_range;
    TagTotals regions;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners corners = corners_of(mesh, mesh.cells[c]);
        const double size = volume(corners);
        volumes.add(size);
        extend(out.cell_volume, size);
        if (!mesh.regions.empty()) regions.add(mesh.regions[c], size);

        for (const double angle : dihedral_angles(corners)) {
            extend(out.dihedral_angle, angle);
            out.dihedral_histogram.add(angle);
        }
        const double eta = mean_ratio(corners);
        etas.add(eta);
        extend(eta_range, eta);
        out.eta_histogram.add(eta);
    }
    out.volume = volumes.value();
    out.regions = regions.ascending();
    if (eta_range) {
        const double mean = etas.value() / static_cast<double>(mesh.cells.size());
        out.eta = Quality{.min = eta_range->min, .mean = mean, .max = eta_range->max};
    }
}

std::vector<TagTotal> measure_facets(const Mesh& mesh) {
    TagTotals totals;
    if (mesh.facet_markers.empty()) return {};
    for (FacetIndex f{0}; f < mesh.facets.end_index(); ++f) {
        totals.add(mesh.facet_markers[f], area(triangle_of(mesh, mesh.facets[f])));
    }
    return totals.ascending();
}

std::vector<TagTotal> measure_tagged_edges(const Mesh& mesh) {
    TagTotals totals;
    if (mesh.edge_markers.empty()) return {};
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) {
        const auto& [a, b] = mesh.edges[e];
        totals.add(mesh.edge_markers[e], distance(mesh.points[a], mesh.points[b]));
    }
    return totals.ascending();
}

FeatureCounts count_features(const Mesh& mesh) {
    FeatureCounts counts;
    for (const Feature feature : all_features) counts[feature] = mesh.features[feature].size();
    return counts;
}

std::int64_t euler_characteristic(const EntityCounts& counts) {
    const auto plus = static_cast<std::int64_t>(counts.vertices - counts.unused_vertices);
    const auto minus = static_cast<std::int64_t>(counts.edges);
    return plus - minus + static_cast<std::int64_t>(counts.faces) -
           static_cast<std::int64_t>(counts.cells);
}

/// Computes the means. A cell has 6 edges and 4 vertices, a face 3 edges, an edge 2 vertices.
void average(const EntityCounts& counts, Adjacency& adjacency) {
    const auto vertices = static_cast<double>(counts.vertices - counts.unused_vertices);
    const auto edges = static_cast<double>(counts.edges);
    const auto faces = static_cast<double>(counts.faces);
    const auto cells = static_cast<double>(counts.cells);
    adjacency.cells_per_edge = 6 * cells / edges;
    adjacency.cells_per_vertex = 4 * cells / vertices;
    adjacency.edges_per_vertex = 2 * edges / vertices;
    adjacency.faces_per_edge = 3 * faces / edges;
}

}  // namespace

MeshStatistics measure(const Mesh& mesh) {
    const StandardArithmetic standard;
    MeshStatistics out;
    Adjacency adjacency;
    out.counts.vertices = mesh.points.size();
    out.counts.cells = mesh.cells.size();
    out.counts.tagged_facets = mesh.facets.size();
    out.counts.tagged_edges = mesh.edges.size();
    measure_vertices(mesh, out, adjacency);
    measure_edges(mesh, out, adjacency);
    measure_faces(mesh, out);
    measure_cells(mesh, out);
    out.facet_markers = measure_facets(mesh);
    out.edge_markers = measure_tagged_edges(mesh);
    out.features = count_features(mesh);
    out.counts.components = count_components(mesh);
    out.counts.euler_characteristic = euler_characteristic(out.counts);
    if (!mesh.cells.empty()) {
        average(out.counts, adjacency);
        out.adjacency = adjacency;
    }
    return out;
}

}  // namespace octetra::quality
