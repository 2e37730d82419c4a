#include "numbering/canonical_numbers.hpp"

#include <algorithm>
#include <vector>

#include <octetra/core/huge_pages.hpp>

#include "numbering/ranked.hpp"
#include "sharing/vertex_sharing.hpp"

namespace octetra::distributed {
namespace {

/// Returns the vertices that other processes have, too, ascending. A shared midpoint is an end of a
/// shared edge, one of the halves of its own edge, so the interfaces have it. Vertices that are
/// shared without a shared edge are input vertices, which `input_sharing` has.
std::vector<VertexIndex> shared_vertices_of(const DistributedMesh& mesh,
                                            const Sharing<VertexIndex>& input_sharing) {
    std::vector<VertexIndex> shared = input_sharing.shared();
    for (const Interface& interface : mesh.interfaces) {
        for (const EdgeVertices& edge : interface.edges) {
            shared.insert(shared.end(), edge.begin(), edge.end());
        }
    }
    std::ranges::sort(shared);
    shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
    return shared;
}

}  // namespace

void CanonicalNumbers::number_midpoints(const Communicator& processes,
                                        std::span<const EdgeVertices> ends,
                                        std::span<const VertexIndex> shared_vertices) {
    if (processes.size() == 1) {  // vertices are in canonical order
        make_room(of_vertex, of_vertex.size() + ends.size());
        for (std::size_t k = 0; k < ends.size(); ++k) {
            of_vertex.push_back(GlobalVertex{of_vertex.size()});
        }
        vertex_count = of_vertex.size();
        return;
    }
    append_ranked<2>(of_vertex, processes, ends, of_vertex, shared_vertices, vertex_count,
                     vertex_count);
}

std::span<const EdgeVertices> midpoint_ends(const DistributedMesh& mesh, std::size_t level) {
    const std::size_t input_count = mesh.input_vertices.size();
    const std::size_t begin = mesh.level_begin[level].value() - input_count;
    const std::size_t end = level + 1 < mesh.level_begin.size()
                                ? mesh.level_begin[level + 1].value() - input_count
                                : mesh.midpoint_to_edge.size();
    return std::span(mesh.midpoint_to_edge).subspan(begin, end - begin);
}

void CanonicalNumbers::forget_from(VertexIndex end, std::uint64_t count) noexcept {
    if (end < of_vertex.end_index()) of_vertex.resize(end.value());
    vertex_count = count;
}

CanonicalNumbers input_numbers(const DistributedMesh& mesh) {
    CanonicalNumbers numbers;
    numbers.of_vertex.assign(mesh.input_vertices.begin(), mesh.input_vertices.end());
    numbers.vertex_count = mesh.input_vertex_count;
    return numbers;
}

CanonicalNumbers canonical_numbers(const DistributedMesh& mesh) {
    return mesh.processes.transaction([&] {
        std::vector<VertexIndex> shared;
        if (mesh.processes.size() > 1) shared = shared_vertices_of(mesh, find_vertex_sharing(mesh));
        CanonicalNumbers numbers = input_numbers(mesh);
        numbers.of_vertex.reserve(mesh.points.size());
        // All processes have the same number of levels.
        for (std::size_t level = 0; level < mesh.level_begin.size(); ++level) {
            numbers.number_midpoints(mesh.processes, midpoint_ends(mesh, level), shared);
        }
        return numbers;
    });
}

}  // namespace octetra::distributed
