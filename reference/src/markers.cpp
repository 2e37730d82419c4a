#include "markers.hpp"

#include <algorithm>

namespace octetra::reference {

IndexVector<EdgeIndex, Marker> midpoint_markers(const Mesh& mesh, const EdgeTable& table) {
    IndexVector<EdgeIndex, Marker> markers(table.edges.size(), 0);
    EdgeSet met(table.edges.size(), false);
    const auto take = [&](EdgeIndex e, Marker marker) {
        markers[e] = met[e] != 0 ? std::min(markers[e], marker) : marker;
        met[e] = true;
    };
    for (FacetIndex f{0}; f < mesh.facet_markers.end_index(); ++f) {
        for (const auto& [i, j] : triangle_edges) {
            take(find_edge(table, mesh.facets[f][i], mesh.facets[f][j]), mesh.facet_markers[f]);
        }
    }
    // A tagged edge overrules the facets; listed twice, it has the smaller of its markers.
    met.assign(met.size(), false);
    for (EdgeIndex tagged{0}; tagged < mesh.edge_markers.end_index(); ++tagged) {
        take(find_edge(table, mesh.edges[tagged][0], mesh.edges[tagged][1]),
             mesh.edge_markers[tagged]);
    }
    return markers;
}

}  // namespace octetra::reference
