#include "setup/part_vertices.hpp"

#include <algorithm>

namespace octetra::distributed {
namespace {

/// Counts the processes that request each vertex of this process's share: 0, 1, or 2 for several.
/// This process then requests the vertices that no process has requested.
std::vector<std::uint8_t> request_unrequested(int rank, const MeshShare& share,
                                              VerticesOfPart& vertices) {
    std::vector<std::uint8_t> request_counts(share.lists.points.size(), 0);
    for (const auto& numbers : vertices.requests.received) {
        for (const std::uint32_t number : numbers) {
            std::uint8_t& times = request_counts[number - share.first_vertex];
            times = times == 0 ? 1 : 2;
        }
    }
    std::vector<std::uint32_t> unrequested;
    for (std::size_t i = 0; i < request_counts.size(); ++i) {
        if (request_counts[i] > 0) continue;
        unrequested.push_back(static_cast<std::uint32_t>(share.first_vertex + i));
    }
    if (unrequested.empty()) return request_counts;
    vertices.set.add(unrequested);
    auto& own = vertices.requests.sent[static_cast<std::size_t>(rank)];
    const auto middle = static_cast<std::ptrdiff_t>(own.size());
    own.insert(own.end(), unrequested.begin(), unrequested.end());
    std::inplace_merge(own.begin(), own.begin() + middle, own.end());
    vertices.requests.received[static_cast<std::size_t>(rank)] = own;
    return request_counts;
}

}  // namespace

VerticesOfPart find_vertices(const Communicator& processes, const OwnerMap& owners,
                             const MeshShare& share,
                             const IndexVector<CellIndex, CellVertices>& cells) {
    VerticesOfPart vertices;
    vertices.set = VertexSet(cells);
    vertices.requests = request(processes, owners, vertices.set.numbers());
    std::vector<std::uint8_t> request_counts =
        request_unrequested(processes.rank(), share, vertices);
    for (std::uint8_t& times : request_counts) times = times == 2 ? 1 : 0;
    vertices.is_shared = fetch(processes, vertices.requests, request_counts, share.first_vertex);
    return vertices;
}

void fetch_vertices(const Communicator& processes, const VerticesOfPart& vertices,
                    const MeshShare& share, DistributedMesh& mesh) {
    const auto fetch_owned = [&](const auto& owned, std::size_t components = 1) {
        return fetch(processes, vertices.requests, owned, share.first_vertex, components);
    };
    const Mesh& lists = share.lists;
    {
        const std::vector<Point> points =
            fetch_owned(static_cast<const std::vector<Point>&>(lists.points));
        mesh.points.assign(points.begin(), points.end());
    }
    if (share.facts.has_point_markers) {
        mesh.input_vertex_markers =
            fetch_owned(static_cast<const std::vector<Marker>&>(lists.point_markers));
    }
    mesh.attributes_per_point = share.facts.attributes_per_point;
    if (mesh.attributes_per_point > 0) {
        mesh.point_attributes = fetch_owned(lists.point_attributes, mesh.attributes_per_point);
    }
    mesh.input_vertices.reserve(vertices.set.size());
    for (const std::uint32_t number : vertices.set.numbers()) {
        mesh.input_vertices.push_back(GlobalVertex{number});
    }
}

}  // namespace octetra::distributed
