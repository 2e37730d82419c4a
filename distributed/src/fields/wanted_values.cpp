#include "fields/wanted_values.hpp"

#include <utility>

namespace octetra::distributed {

WantedEntities wanted_vertices(const CanonicalNumbers& numbers) {
    WantedEntities wanted;
    for (VertexIndex v{0}; v < numbers.of_vertex.end_index(); ++v) {
        wanted.numbers.push_back(static_cast<std::uint64_t>(numbers.of_vertex[v]));
        wanted.local.push_back(v.value());
    }
    return wanted;
}

WantedEntities wanted_cells(const CanonicalRuns& runs, const AncestorMap& ancestors,
                            std::span<const CellIndex> cells_before) {
    WantedEntities wanted;
    for_each_between(
        runs, ancestors, 0, runs.count, [&](std::uint64_t number, std::size_t place, std::size_t) {
            wanted.numbers.push_back(number);
            wanted.local.push_back(cells_before.empty() ? static_cast<std::uint32_t>(place)
                                                        : cells_before[place].value());
        });
    return wanted;
}

WantedValues ask_for(const Communicator& processes, WantedEntities entities, Homes homes) {
    LocalFailure failure;
    WantedValues wanted{std::move(entities), std::move(homes), {}};
    wanted.requests = request(processes, wanted.homes, wanted.entities.numbers, failure);
    return wanted;
}

}  // namespace octetra::distributed
