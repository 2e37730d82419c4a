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

AppendedMidpoints::AppendedMidpoints(DistributedMesh& mesh)
    : mesh_(&mesh), vertex_count_(mesh.points.size()), level_count_(mesh.level_begin.size()) {
    mesh.level_begin.push_back(mesh.points.end_index());
}

AppendedMidpoints::~AppendedMidpoints() {
    if (mesh_ == nullptr) return;
    const auto shorten = [](auto& list, std::size_t count) {
        if (list.size() > count) list.resize(count);
    };
    const std::size_t midpoint_count = vertex_count_ - mesh_->input_vertices.size();
    shorten(mesh_->level_begin, level_count_);
    shorten(mesh_->points, vertex_count_);
    shorten(mesh_->point_attributes, mesh_->attributes_per_point * vertex_count_);
    shorten(mesh_->midpoint_to_edge, midpoint_count);
    shorten(mesh_->midpoint_markers, midpoint_count);
}

void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high) {
    mesh.points.push_back(midpoint(mesh.points[low], mesh.points[high]));
    mesh.midpoint_to_edge.push_back({low, high});
    append_attributes(mesh, low, high);
}

void merge_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker) {
    if (source < known.source) return;
    if (source > known.source || marker < known.marker) known = {source, marker};
}

}  // namespace octetra::distributed
