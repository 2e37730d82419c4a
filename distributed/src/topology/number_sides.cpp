#include "topology/number_sides.hpp"

#include <algorithm>
#include <numeric>

#include <octetra/core/error.hpp>

#include "numbering/ranked.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

template <std::size_t N>
using SideCorners = std::array<VertexIndex, N>;

/// Determines local numbers: sides are grouped by their lowest vertices and sorted there.
template <class I, std::size_t N, std::size_t PerCell>
void number_locally(const DistributedMesh& mesh,
                    const std::array<std::array<std::uint8_t, N>, PerCell>& places,
                    Sides<I, N, PerCell>& sides) {
    const std::size_t count = PerCell * mesh.cells.size();
    if (count >= I::limit) throw InputError("too many cells on one process to number their sides");
    const auto corners_of = [&](std::size_t side) {
        SideCorners<N> corners;
        for (std::size_t k = 0; k < N; ++k) {
            corners[k] = mesh.cells[CellIndex{side / PerCell}][places[side % PerCell][k]];
        }
        std::ranges::sort(corners);
        return corners;
    };
    std::vector<std::uint32_t> begin(mesh.points.size() + 1, 0);
    for (std::size_t side = 0; side < count; ++side) ++begin[corners_of(side)[0].value()];
    std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> at_vertex(count);
    for (std::size_t side = count; side-- > 0;) {
        at_vertex[--begin[corners_of(side)[0].value()]] = static_cast<std::uint32_t>(side);
    }
    sides.of_cell.resize(mesh.cells.size());
    std::vector<std::pair<SideCorners<N>, std::uint32_t>> star;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        star.clear();
        for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) {
            star.emplace_back(corners_of(at_vertex[k]), at_vertex[k]);
        }
        std::sort(star.begin(), star.end());
        for (const auto& [corners, side] : star) {
            if (sides.vertices.empty() || sides.vertices.back() != corners) {
                sides.vertices.push_back(corners);
            }
            sides.of_cell[CellIndex{side / PerCell}][side % PerCell] = I{sides.vertices.size() - 1};
        }
    }
}

template <class I, std::size_t N, std::size_t PerCell>
I find(const Sides<I, N, PerCell>& sides, SideCorners<N> corners) {
    std::ranges::sort(corners);
    const auto found = std::ranges::lower_bound(sides.vertices, corners);
    return I{static_cast<std::size_t>(found - sides.vertices.begin())};
}

/// Collective. Numbers sides; `shared_of(interface)` returns the sides in its list.
template <class I, std::size_t N, std::size_t PerCell>
Sides<I, N, PerCell> number(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                            std::span<const VertexIndex> shared_vertices,
                            const std::array<std::array<std::uint8_t, N>, PerCell>& places,
                            auto&& shared_of) {
    Sides<I, N, PerCell> sides;
    SharingBuilder<I> sharing(sides.sharing, mesh.processes.rank());
    number_locally(mesh, places, sides);
    // The local and global numbers of vertices have the same order, so sides are ascending by
    // either.
    append_ranked<N>(sides.numbers, mesh.processes, sides.vertices, numbers.of_vertex,
                     shared_vertices, numbers.vertex_count, sides.count);
    for (const Interface& interface : mesh.interfaces) {
        std::vector<I> shared;
        for (const auto& corners : shared_of(interface)) shared.push_back(find(sides, corners));
        sharing.share(interface.rank, std::move(shared));
    }
    sharing.prepare([&](I i) { return sides.numbers[i]; });
    sharing.commit();
    return sides;
}

}  // namespace

MeshEdges number_edges(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                       std::span<const VertexIndex> shared_vertices) {
    return number<EdgeIndex>(
        mesh, numbers, shared_vertices, cell_edges,
        [](const Interface& i) -> const auto& { return i.edges; });
}

MeshFaces number_faces(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                       std::span<const VertexIndex> shared_vertices) {
    return number<FaceIndex>(
        mesh, numbers, shared_vertices, cell_faces,
        [](const Interface& i) -> const auto& { return i.faces; });
}

}  // namespace octetra::distributed
