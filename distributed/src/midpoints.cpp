#include "midpoints.hpp"

#include <algorithm>

#include "huge_pages.hpp"

namespace octetra::distributed {
namespace {

/// How each edge's midpoint would be marked.
IndexVector<EdgeIndex, MidpointMarker> edge_markers(const DistributedMesh& mesh,
                                                    const EdgeStars& stars) {
    IndexVector<EdgeIndex, MidpointMarker> markers(stars.end_index().value());
    const Lineage& facets = mesh.facet_lineage;
    for (std::size_t r = 0; r < facets.markers.size(); ++r) {
        for (FacetIndex f{facets.first[r]}; f < FacetIndex{facets.first[r + 1]}; ++f) {
            for (const auto& [i, j] : triangle_edges) {
                take_marker(markers[stars.find(mesh.facets[f][i], mesh.facets[f][j])],
                            MidpointMarker::Source::facet, facets.markers[r]);
            }
        }
    }
    const Lineage& edges = mesh.edge_lineage;
    for (std::size_t r = 0; r < edges.markers.size(); ++r) {
        for (EdgeIndex e{edges.first[r]}; e < EdgeIndex{edges.first[r + 1]}; ++e) {
            take_marker(markers[stars.find(mesh.edges[e][0], mesh.edges[e][1])],
                        MidpointMarker::Source::edge, edges.markers[r]);
        }
    }
    return markers;
}

void append_attributes(DistributedMesh& mesh, VertexIndex a, VertexIndex b) {
    const std::size_t count = mesh.attributes_per_point;
    for (std::size_t k = 0; k < count; ++k) {
        const double sum = mesh.point_attributes[a.value() * count + k] +
                           mesh.point_attributes[b.value() * count + k];
        mesh.point_attributes.push_back(sum / 2);
    }
}

}  // namespace

void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high) {
    mesh.points.push_back(midpoint(mesh.points[low], mesh.points[high]));
    mesh.midpoint_to_edge.push_back({low, high});
    append_attributes(mesh, low, high);
}

void take_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker) {
    if (source < known.source) return;
    if (source > known.source || marker < known.marker) known = {source, marker};
}

IndexVector<EdgeIndex, VertexIndex> bisect_edges(DistributedMesh& mesh, const EdgeStars& stars,
                                                 const DenseClosure& closure) {
    const bool has_markers = !mesh.input_vertex_markers.empty();
    const auto markers =
        has_markers ? edge_markers(mesh, stars) : IndexVector<EdgeIndex, MidpointMarker>{};
    IndexVector<EdgeIndex, VertexIndex> midpoints;
    reserve_in_huge_pages(midpoints, stars.end_index().value());
    midpoints.assign(stars.end_index().value(), VertexIndex::none());
    const VertexIndex old_end = mesh.points.end_index();
    mesh.level_begin.push_back(old_end);

    const std::size_t count = closure.selected_count();
    reserve_in_huge_pages(mesh.points, mesh.points.size() + count);
    reserve_in_huge_pages(mesh.midpoint_to_edge, mesh.midpoint_to_edge.size() + count);

    std::vector<EdgeIndex> selected;  // those of one lower end
    for (VertexIndex low{0}; low < old_end; ++low) {
        selected.clear();
        for (EdgeIndex e = stars.begin_of(low); e < stars.end_of(low); ++e) {
            if (closure.is_selected(e)) selected.push_back(e);
        }
        std::ranges::sort(selected, {}, [&](EdgeIndex e) { return stars.high_end(e); });
        for (const EdgeIndex e : selected) {
            midpoints[e] = mesh.points.end_index();
            append_midpoint(mesh, low, stars.high_end(e));
            if (has_markers) mesh.midpoint_markers.push_back(markers[e]);
        }
    }
    return midpoints;
}

}  // namespace octetra::distributed
