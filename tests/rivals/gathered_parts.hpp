#pragma once

#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "distributed/world.hpp"
#include "rivals/ranks/terminal_edges_on_ranks.hpp"

/// Gathers the parts of all ranks.
namespace octetra::rivals {

/// Collective. The whole mesh on every rank, and whether all copies of a vertex have the same bits.
struct GatheredParts {
    Mesh mesh;
    std::vector<std::uint64_t> roots;
    bool copies_agree = true;
};

inline bool have_same_bits(const Point& a, const Point& b) {
    const auto bytes = [](const Point& p) { return std::as_bytes(std::span(&p, 1)); };
    return std::ranges::equal(bytes(a), bytes(b));
}

inline GatheredParts gathered_parts(const PartOfMesh& part) {
    const auto points = test::of_all<Point>(part.mesh.points);
    const auto numbers = test::of_all<std::uint64_t>(part.vertex_numbers);
    const auto cells = test::of_all<CellVertices>(part.mesh.cells);
    const auto roots = test::of_all<std::uint64_t>(part.roots);
    const auto regions = test::of_all<Marker>(part.mesh.regions);
    GatheredParts whole;
    std::map<std::uint64_t, Point> point_of_number;
    std::multimap<std::uint64_t, std::pair<CellVertices, Marker>> cells_of_root;  // in order
    for (std::size_t r = 0; r < points.size(); ++r) {
        for (std::size_t v = 0; v < points[r].size(); ++v) {
            const auto [at, _] = point_of_number.try_emplace(numbers[r][v], points[r][v]);
            if (!have_same_bits(at->second, points[r][v])) whole.copies_agree = false;
        }
        for (std::size_t c = 0; c < cells[r].size(); ++c) {
            CellVertices cell = cells[r][c];
            for (VertexIndex& v : cell) v = VertexIndex{numbers[r][v.value()]};
            cells_of_root.emplace(roots[r][c],
                                  std::pair{cell, regions[r].empty() ? Marker{} : regions[r][c]});
        }
    }
    for (const auto& [number, point] : point_of_number) {
        if (number != whole.mesh.points.size()) whole.copies_agree = false;
        whole.mesh.points.push_back(point);
    }
    for (const auto& [root, cell] : cells_of_root) {
        whole.roots.push_back(root);
        whole.mesh.cells.push_back(cell.first);
        whole.mesh.regions.push_back(cell.second);
    }
    return whole;
}

/// Random parts 0 to `parts` - 1, some of which may be empty.
inline std::vector<int> random_parts(std::size_t cells, std::size_t parts, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<int> part_of_cell(cells);
    for (int& part : part_of_cell) part = static_cast<int>(random() % parts);
    return part_of_cell;
}

/// The goal of a rank, for the cells of its part.
inline Goal own_goal(const Goal& goal, const PartOfMesh& part) {
    Goal own = goal;
    own.targets.clear();
    if (goal.targets.empty()) return own;
    for (const std::uint64_t root : part.roots) own.targets.push_back(goal.targets[root]);
    return own;
}

}  // namespace octetra::rivals
