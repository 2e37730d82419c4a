#include "markers.hpp"

#include <algorithm>

namespace octetra::reference {

IndexVector<EdgeIndex, Marker> midpoint_markers(const Mesh& mesh, const EdgeTable& table) {
    IndexVector<EdgeIndex, Marker> markers(table.edges.size(), 0);
    EdgeSet met(table.edges.size(), false);
    for (FacetIndex f{0}; f < mesh.facet_markers.end_index(); ++f) {
        for (const auto& [i, j] : triangle_edges) {
            const EdgeIndex e = find_edge(table, mesh.facets[f][i], mesh.facets[f][j]);
            const Marker marker = mesh.facet_markers[f];
            markers[e] = met[e] != 0 ? std::min(markers[e], marker) : marker;
            met[e] = true;
        }
    }
    for (EdgeIndex listed{0}; listed < mesh.edge_markers.end_index(); ++listed) {
        const EdgeIndex e = find_edge(table, mesh.edges[listed][0], mesh.edges[listed][1]);
        markers[e] = mesh.edge_markers[listed];
    }
    return markers;
}

}  // namespace octetra::reference
