#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/distributed/communicator.hpp>

#include "setup/owners.hpp"

namespace octetra::distributed {

/// A tagged facet or edge that is being sent to a process with a cell at it.
template <std::size_t N>
struct Tagged {
    std::uint64_t number = 0;
    VertexNumbers<N> vertices{};
    Marker marker = 0;
};

/// Collective. Sends the facets or edges that this process reads to the owners of their first
/// vertices.
template <std::size_t N>
[[nodiscard]] std::vector<Tagged<N>> send_to_owners(const Communicator& processes,
                                                    const CheckpointReader& file,
                                                    const OwnerMap& vertex_owners, Section section,
                                                    Section markers) {
    const OwnerMap owners =
        owners_of_blocks(shape_of(file.facts(), section).count, block_length, processes.size());
    const std::uint64_t begin = owners.begin_of(processes.rank());
    const std::uint64_t end = owners.end_of(processes.rank());
    const auto lists = file.read_vertices<N>(section, begin, end);
    const auto tags = file.read<Marker>(markers, begin, end);
    std::vector<std::vector<Tagged<N>>> to_owners(static_cast<std::size_t>(processes.size()));
    for (std::size_t i = 0; i < lists.size(); ++i) {
        const auto owner = static_cast<std::size_t>(vertex_owners.rank_of(lists[i][0]));
        to_owners[owner].push_back({begin + i, lists[i], tags.empty() ? Marker{0} : tags[i]});
    }
    std::vector<Tagged<N>> owned;
    for (const auto& box : processes.all_to_all(to_owners)) {
        owned.insert(owned.end(), box.begin(), box.end());
    }
    std::ranges::sort(owned, {}, [](const Tagged<N>& tagged) { return tagged.vertices[0]; });
    return owned;
}

/// Collective. Sends them on to all processes that have requested their first vertex.
template <std::size_t N>
[[nodiscard]] std::vector<Tagged<N>> send_to_parts(const Communicator& processes,
                                                   const Requests<>& requests,
                                                   const std::vector<Tagged<N>>& owned) {
    std::vector<std::vector<Tagged<N>>> to_parts(static_cast<std::size_t>(processes.size()));
    for (std::size_t rank = 0; rank < to_parts.size(); ++rank) {
        auto next = owned.begin();
        for (const std::uint64_t number : requests.received[rank]) {  // ascending
            while (next != owned.end() && next->vertices[0] < number) ++next;
            for (auto k = next; k != owned.end() && k->vertices[0] == number; ++k) {
                to_parts[rank].push_back(*k);
            }
        }
    }
    std::vector<Tagged<N>> received;
    for (const auto& box : processes.all_to_all(to_parts)) {
        received.insert(received.end(), box.begin(), box.end());
    }
    return received;
}

/// Returns the entities that are sides of `cells`, sorted by number.
template <std::size_t N, std::size_t Sides>
[[nodiscard]] std::vector<Tagged<N>> sides_among(
    const std::vector<Tagged<N>>& received, const auto& cells,
    const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::vector<std::pair<VertexNumbers<N>, Tagged<N>>> candidates;
    for (const Tagged<N>& tagged : received) {
        VertexNumbers<N> key = tagged.vertices;
        std::ranges::sort(key);
        candidates.emplace_back(key, tagged);
    }
    const auto key_of = [](const auto& candidate) -> const VertexNumbers<N>& {
        return candidate.first;
    };
    std::ranges::sort(candidates, {}, key_of);
    std::vector<bool> is_side(candidates.size(), false);
    for (const auto& cell : cells) {
        if (candidates.empty()) break;
        for (const auto& side : sides) {
            VertexNumbers<N> key;
            for (std::size_t k = 0; k < N; ++k) key[k] = cell.corners[side[k]];
            std::ranges::sort(key);
            auto found = std::ranges::lower_bound(candidates, key, {}, key_of);
            for (; found != candidates.end() && found->first == key; ++found) {
                is_side[static_cast<std::size_t>(found - candidates.begin())] = true;
            }
        }
    }
    std::vector<Tagged<N>> tagged;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (is_side[i]) tagged.push_back(candidates[i].second);
    }
    std::ranges::sort(tagged, {}, &Tagged<N>::number);
    return tagged;
}

/// Collective. Throws if a facet or edge of the file is a side of no cell. The processes that have
/// a cell at an entity report this to the process that has read it.
template <std::size_t N>
void check_all_are_sides(const Communicator& processes, const CheckpointReader& file,
                         Section section, const std::vector<Tagged<N>>& tagged) {
    const OwnerMap owners =
        owners_of_blocks(shape_of(file.facts(), section).count, block_length, processes.size());
    std::vector<std::vector<std::uint64_t>> outboxes(static_cast<std::size_t>(processes.size()));
    for (const Tagged<N>& one : tagged) {
        outboxes[static_cast<std::size_t>(owners.rank_of(one.number))].push_back(one.number);
    }
    const auto inboxes = processes.all_to_all(outboxes);
    const std::uint64_t begin = owners.begin_of(processes.rank());
    std::vector<bool> is_side(owners.end_of(processes.rank()) - begin, false);
    for (const auto& inbox : inboxes) {
        for (const std::uint64_t number : inbox) is_side[number - begin] = true;
    }
    const auto stray = std::ranges::find(is_side, false);
    if (stray == is_side.end()) return;
    const std::uint64_t number = begin + static_cast<std::uint64_t>(stray - is_side.begin());
    file.fail(section, number / block_length, fmt::format("number {} belongs to no cell", number));
}

/// Collective, within a transaction. Returns the facets or edges that are sides of this process's
/// cells. Each is sent from its reader to the owner of its first vertex, and from there to all
/// processes that have requested that vertex.
template <std::size_t N, std::size_t Sides>
[[nodiscard]] std::vector<Tagged<N>> load_tagged(
    const Communicator& processes, const CheckpointReader& file, const OwnerMap& vertex_owners,
    const Requests<>& requests, const auto& cells, Section section, Section markers,
    const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    const auto owned = send_to_owners<N>(processes, file, vertex_owners, section, markers);
    auto tagged = sides_among(send_to_parts(processes, requests, owned), cells, sides);
    check_all_are_sides(processes, file, section, tagged);
    return tagged;
}

}  // namespace octetra::distributed
