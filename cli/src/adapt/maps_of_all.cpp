#include "adapt/maps_of_all.hpp"

#include <cstdint>

#include <octetra/core/window_pieces.hpp>

namespace octetra::cli {

RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world) {
    const MeshFacts& facts = fine.facts();
    constexpr std::uint64_t at_once = std::uint64_t{1} << 16U;
    RefinementMaps maps;
    if (world.is_first()) maps.cell_to_parent.reserve(facts.cells);
    for_each_piece(whole_window(facts.cells), at_once, [&](const Window& window) {
        for (const std::uint64_t parent : fine.parents(window)) {
            maps.cell_to_parent.push_back(CellIndex{parent});
        }
    });
    const Window midpoints = whole_window(facts.vertices - facts.first_midpoint);
    for_each_piece(midpoints, at_once, [&](const Window& window) {
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
