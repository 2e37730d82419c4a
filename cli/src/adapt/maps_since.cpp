#include "adapt/maps_since.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "adapt/cell_numbers.hpp"

namespace octetra::cli {

CellsSince::CellsSince(const distributed::AdaptiveMesh& mesh)
    : vertices_(mesh.vertex_count()), parents_(cell_numbers(mesh)) {}

void CellsSince::follow(const distributed::Migration& move) {
    parents_ = move.cells(std::move(parents_));
}

void CellsSince::follow(const distributed::Adaptation& step) {
    parents_ = step.transfer_cells(std::move(parents_));
}

MapsSince::MapsSince(const distributed::AdaptiveMesh& mesh, const CellsSince& since)
    : group_(&mesh.processes()), mesh_(mesh.canonical()), facts_(mesh_.facts()) {
    midpoints_before_ = since.vertex_count_before() - facts_.first_midpoint;
    facts_.first_midpoint = since.vertex_count_before();
    const std::vector<std::uint64_t> numbers = cell_numbers(mesh);
    own_.reserve(numbers.size());
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        own_.push_back({numbers[c], since.parents()[c]});
    }
    std::ranges::sort(own_, {}, &CellAndParent::cell);
}

std::span<const Point> MapsSince::points(const Window& window) {
    return mesh_.whole().points(window);
}

std::span<const VertexNumbers<4>> MapsSince::cells(const Window& window) {
    return mesh_.whole().cells(window);
}

/// Vertices keep their numbers, so new midpoints follow the earlier ones.
std::span<const VertexNumbers<2>> MapsSince::midpoint_ends(const Window& window) {
    Window all = window;
    all.begin += midpoints_before_;
    all.count += midpoints_before_;
    return mesh_.whole().midpoint_ends(all);
}

std::span<const std::uint64_t> MapsSince::parents(const Window& window) {
    std::vector<std::vector<CellAndParent>> outboxes;
    for (int rank = 0; rank < group_->size(); ++rank) {
        const auto place = [&](std::uint64_t number) {
            return std::ranges::lower_bound(own_, number, {}, &CellAndParent::cell);
        };
        outboxes.emplace_back(place(window.begin_of(rank)), place(window.end_of(rank)));
    }
    const std::uint64_t begin = window.begin_of(group_->rank());
    parents_.assign(window.end_of(group_->rank()) - begin, 0);
    for (const auto& inbox : group_->all_to_all(outboxes)) {
        for (const auto& [number, parent] : inbox) parents_[number - begin] = parent;
    }
    return parents_;
}

}  // namespace octetra::cli
