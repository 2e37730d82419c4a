#include "setup/part_vertices.hpp"

#include <algorithm>

namespace octetra::distributed {
namespace {

/// Counts the processes that request each vertex of this process's share: 0, 1, or 2 for several.
/// This process then requests the vertices that no process has requested.
std::vector<std::uint8_t> keep_unwanted(int rank, const MeshStretch& stretch,
                                        StretchVertices& vertices) {
    std::vector<std::uint8_t> wanted(stretch.lists.points.size(), 0);
    for (const auto& numbers : vertices.requests.received) {
        for (const std::uint32_t number : numbers) {
            std::uint8_t& times = wanted[number - stretch.first_vertex];
            times = times == 0 ? 1 : 2;
        }
    }
    std::vector<std::uint32_t> unwanted;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] > 0) continue;
        unwanted.push_back(static_cast<std::uint32_t>(stretch.first_vertex + i));
    }
    if (unwanted.empty()) return wanted;
    vertices.set.add(unwanted);
    auto& own = vertices.requests.sent[static_cast<std::size_t>(rank)];
    const auto middle = static_cast<std::ptrdiff_t>(own.size());
    own.insert(own.end(), unwanted.begin(), unwanted.end());
    std::inplace_merge(own.begin(), own.begin() + middle, own.end());
    vertices.requests.received[static_cast<std::size_t>(rank)] = own;
    return wanted;
}

}  // namespace

StretchVertices find_vertices(const Communicator& processes, const Homes& homes,
                              const MeshStretch& stretch,
                              const IndexVector<CellIndex, CellVertices>& cells,
                              LocalFailure& failure) {
    StretchVertices vertices;
    std::vector<std::uint32_t> numbers;
    failure.attempt([&] {
        vertices.set = VertexSet(cells);
        numbers = vertices.set.numbers();
    });
    vertices.requests = request(processes, homes, numbers, failure);
    std::vector<std::uint8_t> wanted;
    failure.attempt([&] {
        wanted = keep_unwanted(processes.rank(), stretch, vertices);
        for (std::uint8_t& times : wanted) times = times == 2 ? 1 : 0;
    });
    vertices.is_shared = fetch(processes, vertices.requests, wanted, stretch.first_vertex, failure);
    return vertices;
}

void bring_vertices(const Communicator& processes, const StretchVertices& vertices,
                    const MeshStretch& stretch, DistributedMesh& mesh, LocalFailure& failure) {
    const auto bring = [&](const auto& home, std::size_t components = 1) {
        return fetch(processes, vertices.requests, home, stretch.first_vertex, failure, components);
    };
    const Mesh& lists = stretch.lists;
    {
        const std::vector<Point> points =
            bring(static_cast<const std::vector<Point>&>(lists.points));
        failure.attempt([&] { mesh.points.assign(points.begin(), points.end()); });
    }
    if (stretch.facts.has_point_markers) {
        mesh.input_vertex_markers =
            bring(static_cast<const std::vector<Marker>&>(lists.point_markers));
    }
    mesh.attributes_per_point = stretch.facts.attributes_per_point;
    if (mesh.attributes_per_point > 0) {
        mesh.point_attributes = bring(lists.point_attributes, mesh.attributes_per_point);
    }
    failure.attempt([&] {
        mesh.input_vertices.reserve(vertices.set.size());
        for (const std::uint32_t number : vertices.set.numbers()) {
            mesh.input_vertices.push_back(GlobalVertex{number});
        }
    });
    failure.agree(processes);
}

}  // namespace octetra::distributed
