#pragma once

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The midpoints that a level appends to a mesh's vertices: taken back unless they are kept.
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

/// Appends the midpoint of an edge to the mesh's vertices, and its ends and attributes to those
/// lists; not its marker.
void append_midpoint(DistributedMesh& mesh, VertexIndex low, VertexIndex high);

/// Learns that the edge of a midpoint is tagged, or in a tagged facet, with this marker: an edge
/// tells more than a facet, a facet more than nothing; among equals the smallest marker counts.
void take_marker(MidpointMarker& known, MidpointMarker::Source source, Marker marker);

}  // namespace octetra::distributed
