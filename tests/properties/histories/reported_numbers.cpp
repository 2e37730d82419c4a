#include "properties/histories/reported_numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace octetra::properties {
namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const Point& p) {
    return {std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
            std::bit_cast<std::uint64_t>(p.z)};
}

struct SeenVertex {
    std::uint64_t number;
    Bits bits;
};
using SeenCell = std::array<std::uint64_t, 4>;

/// The entries of all processes, on the first one.
template <class T>
std::vector<T> joined(const distributed::Communicator& processes, const std::vector<T>& own) {
    std::vector<T> all;
    for (const auto& of_one : processes.gather(own)) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

std::vector<SeenCell> cells_of(const Mesh& mesh) {
    std::vector<SeenCell> cells;
    for (const CellVertices& cell : mesh.cells) {
        SeenCell& seen = cells.emplace_back();
        std::ranges::transform(cell, seen.begin(), &VertexIndex::value);
    }
    return cells;
}

}  // namespace

std::string fault_of_reported_numbers(const distributed::AdaptiveMesh& mesh, const Mesh& whole) {
    const auto number = [&](VertexIndex v) {
        return static_cast<std::uint64_t>(mesh.vertex_numbers()[v.value()]);
    };
    std::vector<SeenVertex> own_vertices;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        own_vertices.push_back({number(VertexIndex{v}), bits_of(mesh.points()[v])});
    }
    std::vector<SeenCell> own_cells;
    for (const CellVertices& cell : mesh.cells()) {
        std::ranges::transform(cell, own_cells.emplace_back().begin(), number);
    }
    const std::uint64_t most = mesh.processes().max(mesh.vertex_count());
    const auto vertices = joined(mesh.processes(), own_vertices);
    auto cells = joined(mesh.processes(), own_cells);
    if (!mesh.processes().is_first()) return {};

    if (most != whole.points.size()) return "there are not as many vertices as a rank says";
    for (const auto& [v, bits] : vertices) {
        if (v >= most || bits != bits_of(whole.points[VertexIndex{v}])) {
            return "a vertex on a rank has a wrong number";
        }
    }
    auto expected = cells_of(whole);
    std::ranges::sort(expected);
    std::ranges::sort(cells);
    if (cells != expected) return "the ranks' cells are not those of the mesh";
    return {};
}

}  // namespace octetra::properties
