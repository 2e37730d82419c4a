#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Collective. Brings values from the processes that have them to the processes whose slice of a
/// window they are in.
/// `between(begin, end, emit)` calls emit(number, value) for this process's values numbered begin
/// .. end-1; place(position in the slice, value) is called for each value of this process's slice,
/// once for each process that has it.
template <class T>
void bring_to_slices(const Communicator& processes, const Window& window, auto&& between,
                     auto&& place) {
    struct Run {  // of values whose numbers follow each other
        std::uint32_t position;
        std::uint32_t count;
    };
    const auto process_count = static_cast<std::size_t>(processes.size());
    std::vector<std::vector<Run>> runs_to(process_count);
    std::vector<std::vector<T>> values_to(process_count);
    for (int rank = 0; rank < processes.size(); ++rank) {
        const std::uint64_t begin = window.begin_of(rank);
        const std::uint64_t end = window.end_of(rank);
        if (begin == end) continue;
        if (rank == processes.rank()) {
            between(begin, end, [&](std::uint64_t number, const T& value) {
                place(static_cast<std::uint32_t>(number - begin), value);
            });
            continue;
        }
        auto& runs = runs_to[static_cast<std::size_t>(rank)];
        auto& values = values_to[static_cast<std::size_t>(rank)];
        values.reserve((end - begin) / process_count);  // if all have about as many there
        between(begin, end, [&](std::uint64_t number, const T& value) {
            const auto position = static_cast<std::uint32_t>(number - begin);
            if (runs.empty() || runs.back().position + runs.back().count != position) {
                runs.push_back({position, 0});
            }
            ++runs.back().count;
            values.push_back(value);
        });
    }
    const auto runs_from = processes.all_to_all(runs_to);
    const auto values_from = processes.all_to_all(values_to);
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        if (values_from[rank].empty()) continue;  // none, or a failure that all will know
        const T* value = values_from[rank].data();
        for (const Run& run : runs_from[rank]) {
            for (std::uint32_t k = 0; k < run.count; ++k) place(run.position + k, *value++);
        }
    }
}

/// The same, for values that are the same wherever they come from.
template <class T>
void bring_to_slices(const Communicator& processes, const Window& window, auto&& between,
                     std::vector<T>& slice) {
    slice.resize(window.end_of(processes.rank()) - window.begin_of(processes.rank()));
    bring_to_slices<T>(processes, window, between,
                       [&](std::uint32_t position, const T& value) { slice[position] = value; });
}

}  // namespace octetra::distributed
