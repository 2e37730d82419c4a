#include "numbering/canonical_numbers.hpp"

#include <array>
#include <vector>

#include "memory/huge_pages.hpp"
#include "numbering/ranked.hpp"

namespace octetra::distributed {
void CanonicalNumbers::number_midpoints(const DistributedMesh& mesh, VertexIndex end,
                                        LocalFailure& failure) {
    const VertexIndex begin = of_vertex.end_index();
    if (mesh.processes.size() == 1) {  // vertices are in canonical order
        failure.attempt([&] {
            make_room(of_vertex, end.value());
            for (VertexIndex v = begin; v < end; ++v) of_vertex.push_back(GlobalVertex{v.value()});
            vertex_count = of_vertex.size();
        });
        return;
    }
    const auto number = [&](VertexIndex v) { return static_cast<std::uint64_t>(of_vertex[v]); };
    const auto pairs = [&] {
        std::vector<std::array<std::uint64_t, 2>> of_ends;
        of_ends.reserve(end.value() - begin.value());
        for (VertexIndex v = begin; v < end; ++v) {
            const auto& [a, b] = mesh.midpoint_to_edge[v.value() - mesh.input_vertices.size()];
            of_ends.push_back({number(a), number(b)});
        }
        return of_ends;
    };
    const auto places = ranked<2>(mesh.processes, pairs, vertex_count, vertex_count, failure);
    failure.attempt([&] {
        make_room(of_vertex, end.value());
        for (const std::uint64_t place : places) of_vertex.push_back(GlobalVertex{place});
    });
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
    LocalFailure failure;
    CanonicalNumbers numbers;
    failure.attempt([&] {
        numbers = input_numbers(mesh);
        numbers.of_vertex.reserve(mesh.points.size());
    });
    // All processes have as many levels.
    for (std::size_t level = 0; level < mesh.level_begin.size(); ++level) {
        const VertexIndex end = level + 1 < mesh.level_begin.size() ? mesh.level_begin[level + 1]
                                                                    : mesh.points.end_index();
        numbers.number_midpoints(mesh, end, failure);
    }
    failure.agree(mesh.processes);
    return numbers;
}

}  // namespace octetra::distributed
