#include "fields/requested_values.hpp"

#include <utility>

namespace octetra::distributed {

RequestedEntities requested_vertices(const CanonicalNumbers& numbers) {
    RequestedEntities requested;
    for (VertexIndex v{0}; v < numbers.of_vertex.end_index(); ++v) {
        requested.numbers.push_back(static_cast<std::uint64_t>(numbers.of_vertex[v]));
        requested.local.push_back(v.value());
    }
    return requested;
}

RequestedEntities requested_cells(const CanonicalRuns& runs, const AncestorMap& ancestors,
                                  std::span<const CellIndex> cells_before) {
    RequestedEntities requested;
    for_each_between(
        runs, ancestors, 0, runs.count, [&](std::uint64_t number, std::size_t place, std::size_t) {
            requested.numbers.push_back(number);
            requested.local.push_back(cells_before.empty() ? static_cast<std::uint32_t>(place)
                                                           : cells_before[place].value());
        });
    return requested;
}

RequestedValues send_requests(const Communicator& processes, RequestedEntities entities,
                              OwnerMap owners) {
    RequestedValues requested{std::move(entities), std::move(owners), {}};
    requested.requests = request(processes, requested.owners, requested.entities.numbers);
    return requested;
}

}  // namespace octetra::distributed
