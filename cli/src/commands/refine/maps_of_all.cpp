#include "commands/refine/maps_of_all.hpp"

namespace octetra::cli {

RefinementMaps maps_of_all(MeshSource& fine, const distributed::Communicator& world) {
    const MeshFacts& facts = fine.facts();
    RefinementMaps maps;
    for (const std::uint64_t parent : fine.parents(whole_window(facts.cells))) {
        maps.cell_to_parent.push_back(CellIndex{parent});
    }
    const Window midpoints = whole_window(facts.vertices - facts.first_midpoint);
    for (const auto& ends : fine.midpoint_ends(midpoints)) {
        maps.midpoint_to_edge.push_back(indices_of(ends));
    }
    world.broadcast(maps.cell_to_parent);
    world.broadcast(maps.midpoint_to_edge);
    maps.first_midpoint = VertexIndex{facts.first_midpoint};
    return maps;
}

}  // namespace octetra::cli
