#include "level/full_sweep/bisect_edges.hpp"

#include <algorithm>
#include <vector>

#include <octetra/core/huge_pages.hpp>

#include "level/midpoints.hpp"

namespace octetra::distributed {
namespace {

/// Returns the marker of each edge's midpoint.
IndexVector<EdgeIndex, MidpointMarker> edge_markers(const DistributedMesh& mesh,
                                                    const EdgeNumbering& numbering) {
    IndexVector<EdgeIndex, MidpointMarker> markers(numbering.end_index().value());
    const AncestorMap& facets = mesh.facet_ancestors;
    for (std::size_t r = 0; r < facets.markers.size(); ++r) {
        for (FacetIndex f{facets.first[r]}; f < FacetIndex{facets.first[r + 1]}; ++f) {
            for (const auto& [i, j] : triangle_edges) {
                merge_marker(markers[numbering.find(mesh.facets[f][i], mesh.facets[f][j])],
                             MidpointMarker::Source::facet, facets.markers[r]);
            }
        }
    }
    const AncestorMap& edges = mesh.edge_ancestors;
    for (std::size_t r = 0; r < edges.markers.size(); ++r) {
        for (EdgeIndex e{edges.first[r]}; e < EdgeIndex{edges.first[r + 1]}; ++e) {
            merge_marker(markers[numbering.find(mesh.edges[e][0], mesh.edges[e][1])],
                         MidpointMarker::Source::edge, edges.markers[r]);
        }
    }
    return markers;
}

}  // namespace

IndexVector<EdgeIndex, VertexIndex> bisect_edges(DistributedMesh& mesh,
                                                 const EdgeNumbering& numbering,
                                                 const FullSweepClosure& closure) {
    const bool has_markers = !mesh.input_vertex_markers.empty();
    const auto markers =
        has_markers ? edge_markers(mesh, numbering) : IndexVector<EdgeIndex, MidpointMarker>{};
    IndexVector<EdgeIndex, VertexIndex> midpoints;
    reserve_in_huge_pages(midpoints, numbering.end_index().value());
    midpoints.assign(numbering.end_index().value(), VertexIndex::none());
    const VertexIndex old_end = mesh.points.end_index();

    const std::size_t count = closure.marked_count();
    reserve_in_huge_pages(mesh.points, mesh.points.size() + count);
    reserve_in_huge_pages(mesh.midpoint_to_edge, mesh.midpoint_to_edge.size() + count);

    std::vector<EdgeIndex> marked;  // with the same lower end
    for (VertexIndex low{0}; low < old_end; ++low) {
        marked.clear();
        for (EdgeIndex e = numbering.begin_of(low); e < numbering.end_of(low); ++e) {
            if (closure.is_marked(e)) marked.push_back(e);
        }
        std::ranges::sort(marked, {}, [&](EdgeIndex e) { return numbering.high_end(e); });
        for (const EdgeIndex e : marked) {
            midpoints[e] = mesh.points.end_index();
            append_midpoint(mesh, low, numbering.high_end(e));
            if (has_markers) mesh.midpoint_markers.push_back(markers[e]);
        }
    }
    return midpoints;
}

}  // namespace octetra::distributed
