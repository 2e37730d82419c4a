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

/// What this process wants the values of: its vertices, or its cells.
struct WantedEntities {
    std::vector<std::uint64_t> numbers;  ///< ascending, in the whole mesh
    std::vector<std::uint32_t> local;    ///< and by this process's numbers
};
[[nodiscard]] WantedEntities wanted_vertices(const CanonicalNumbers& numbers);
/// `runs` and the ancestors are those of the cells in canonical order; `cells_before` are the
/// numbers by which the values are to go, if not by this order.
[[nodiscard]] WantedEntities wanted_cells(const CanonicalRuns& runs, const AncestorMap& ancestors,
                                          std::span<const CellIndex> cells_before);

/// What is wanted, and who has read it: all asked for.
struct WantedValues {
    WantedEntities entities;
    Homes homes;
    Requests<> requests;
};
/// Collective.
[[nodiscard]] WantedValues ask_for(const Communicator& processes, WantedEntities entities,
                                   Homes homes);

/// Collective. The values, `components` for each, by this process's numbers. `home` are those that
/// this process has read.
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
