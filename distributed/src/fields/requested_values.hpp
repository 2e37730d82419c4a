#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_numbers.hpp"
#include "numbering/canonical_runs.hpp"
#include "setup/owners.hpp"

namespace octetra::distributed {

/// The vertices or cells whose values this process requests.
struct RequestedEntities {
    std::vector<std::uint64_t> numbers;  ///< global numbers, ascending
    std::vector<std::uint32_t> local;    ///< local indices of the same entities
};
[[nodiscard]] RequestedEntities requested_vertices(const CanonicalNumbers& numbers);
/// `runs` and `ancestors` are those of the cells in canonical order. `cells_before` maps canonical
/// local indices to the indices of the values; if it is empty, they are the same.
[[nodiscard]] RequestedEntities requested_cells(const CanonicalRuns& runs,
                                                const AncestorMap& ancestors,
                                                std::span<const CellIndex> cells_before);

/// Requested entities, the owners of the blocks of values, and the requests sent to these owners.
struct RequestedValues {
    RequestedEntities entities;
    OwnerMap owners;
    Requests<> requests;
};
/// Collective. Sends the requests for `entities` to the owners in `owners`.
[[nodiscard]] RequestedValues send_requests(const Communicator& processes,
                                            RequestedEntities entities, OwnerMap owners);

/// Collective. Returns the requested values by local index, `components` for each entity. `owned`
/// are the values that this process has read.
template <class T>
[[nodiscard]] std::vector<T> fetch_values(const Communicator& processes,
                                          const RequestedValues& requested,
                                          const std::vector<T>& owned, std::size_t components) {
    const auto received = fetch(processes, requested.requests, owned,
                                requested.owners.begin_of(processes.rank()), components);
    std::vector<T> values(received.size());
    for (std::size_t i = 0; i < requested.entities.local.size(); ++i) {
        for (std::size_t k = 0; k < components; ++k) {
            values[requested.entities.local[i] * components + k] = received[i * components + k];
        }
    }
    return values;
}

}  // namespace octetra::distributed
