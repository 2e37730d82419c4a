#include "level/midpoints.hpp"

namespace octetra::distributed {
namespace {

void append_attributes(DistributedMesh& mesh, VertexIndex a, VertexIndex b) {
    const std::size_t count = mesh.attributes_per_point;
    for (std::size_t k = 0; k < count; ++k) {
        mesh.point_attributes.push_back(mean(mesh.point_attributes[a.value() * count + k],
                                             mesh.point_attributes[b.value() * count + k]));
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

}  // namespace octetra::distributed
