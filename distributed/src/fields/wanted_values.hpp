#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

#include "numbering/canonical_numbers.hpp"
#include "numbering/canonical_runs.hpp"
#include "setup/homes.hpp"

namespace octetra::distributed {

/// The vertices or cells whose values this process requests.
struct WantedEntities {
    std::vector<std::uint64_t> numbers;  ///< global numbers, ascending
    std::vector<std::uint32_t> local;    ///< local indices of the same entities
};
[[nodiscard]] WantedEntities wanted_vertices(const CanonicalNumbers& numbers);
/// `runs` and `ancestors` are those of the cells in canonical order. `cells_before` maps canonical
/// local indices to the indices of the values; if it is empty, they are the same.
[[nodiscard]] WantedEntities wanted_cells(const CanonicalRuns& runs, const AncestorMap& ancestors,
                                          std::span<const CellIndex> cells_before);

/// Requested entities, the owners of the blocks of values, and the requests sent to these owners.
struct WantedValues {
    WantedEntities entities;
    Homes homes;
    Requests<> requests;
};
/// Collective. Sends the requests for `entities` to the owners in `homes`.
[[nodiscard]] WantedValues ask_for(const Communicator& processes, WantedEntities entities,
                                   Homes homes);

/// Collective. Returns the requested values by local index, `components` for each entity. `home`
/// are the values that this process has read.
template <class T>
[[nodiscard]] std::vector<T> fetch_values(const Communicator& processes, const WantedValues& wanted,
                                          const std::vector<T>& home, std::size_t components) {
    LocalFailure failure;
    const auto come = fetch(processes, wanted.requests, home,
                            wanted.homes.begin_of(processes.rank()), failure, components);
    std::vector<T> values(come.size());
    for (std::size_t i = 0; i < wanted.entities.local.size(); ++i) {
        for (std::size_t k = 0; k < components; ++k) {
            values[wanted.entities.local[i] * components + k] = come[i * components + k];
        }
    }
    return values;
}

}  // namespace octetra::distributed
