#include "adapt/maps_of_all.hpp"

#include <algorithm>
#include <cstdint>

namespace octetra::cli {
namespace {

/// Collective. Calls take(window) for windows that together cover a list, in order. Only the first
/// process has entities of them, few at a time, so that buffers remain small.
void for_each_window_of_first(std::uint64_t count, auto&& take) {
    constexpr std::uint64_t length = std::uint64_t{1} << 16U;
    for (std::uint64_t begin = 0; begin < count; begin += length) {
        take(Window{begin, std::min(length, count - begin), count, count});
    }
}

}  // namespace

RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world) {
    const MeshFacts& facts = fine.facts();
    RefinementMaps maps;
    if (world.is_first()) maps.cell_to_parent.reserve(facts.cells);
    for_each_window_of_first(facts.cells, [&](const Window& window) {
        for (const std::uint64_t parent : fine.parents(window)) {
            maps.cell_to_parent.push_back(CellIndex{parent});
        }
    });
    for_each_window_of_first(facts.vertices - facts.first_midpoint, [&](const Window& window) {
        for (const auto& ends : fine.midpoint_ends(window)) {
            maps.midpoint_to_edge.push_back(indices_of(ends));
        }
    });
    world.broadcast(maps.cell_to_parent);
    world.broadcast(maps.midpoint_to_edge);
    maps.first_midpoint = VertexIndex{facts.first_midpoint};
    return maps;
}

}  // namespace octetra::cli
