#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The midpoints that a level appends to a mesh's vertices; removed by the destructor unless they
/// are kept.
class AppendedMidpoints {
public:
    /// Begins a level of the mesh.
    explicit AppendedMidpoints(DistributedMesh& mesh);
    ~AppendedMidpoints();
    AppendedMidpoints(const AppendedMidpoints&) = delete;
    AppendedMidpoints& operator=(const AppendedMidpoints&) = delete;
    AppendedMidpoints(AppendedMidpoints&&) = delete;
    AppendedMidpoints& operator=(AppendedMidpoints&&) = delete;

    void keep() noexcept { mesh_ = nullptr; }

private:
    DistributedMesh* mesh_;
    std::size_t vertex_count_;
    std::size_t level_count_;
};

/// Appends the midpoint of an edge to the mesh's vertices, with its ends and attributes, but not
/// its marker.
void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high);

/// Updates the marker of a midpoint: its edge is tagged, or is an edge of a tagged facet, with this
/// marker. An edge takes precedence over a facet, and a facet over no source; with equal sources
/// the smallest marker wins.
void merge_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker);

}  // namespace octetra::distributed
