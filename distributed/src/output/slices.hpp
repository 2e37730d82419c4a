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
    struct Parcel {
        std::uint32_t position;
        T value;
    };
    std::vector<std::vector<Parcel>> outboxes(static_cast<std::size_t>(processes.size()));
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
        auto& outbox = outboxes[static_cast<std::size_t>(rank)];
        outbox.reserve((end - begin) / outboxes.size());  // if all have about as many there
        between(begin, end, [&](std::uint64_t number, const T& value) {
            outbox.push_back({static_cast<std::uint32_t>(number - begin), value});
        });
    }
    for (const auto& inbox : processes.all_to_all(outboxes)) {
        for (const Parcel& parcel : inbox) place(parcel.position, parcel.value);
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
