#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Another process that has the same key.
struct Sharer {
    std::uint32_t key = 0;  ///< index among this process's keys
    std::int32_t rank = 0;

    friend auto operator<=>(const Sharer&, const Sharer&) = default;
};

/// Calls meet(processes, positions) for each key that several processes have sent, with these
/// processes, ascending, and the index of the key in the list of each. Each process's keys ascend.
template <class Key>
void for_each_common(const std::vector<std::vector<Key>>& from_each, auto&& meet) {
    std::vector<std::pair<Key, std::size_t>> queue;  // a heap of pairs (next key, process)
    std::vector<std::size_t> next(from_each.size(), 0);
    const auto enqueue = [&](std::size_t r) {
        if (next[r] == from_each[r].size()) return;
        queue.emplace_back(from_each[r][next[r]], r);
        std::ranges::push_heap(queue, std::greater{});
    };
    for (std::size_t r = 0; r < from_each.size(); ++r) enqueue(r);
    std::vector<std::int32_t> ranks;
    std::vector<std::uint32_t> positions;
    while (queue.size() > 1) {
        const Key key = queue.front().first;
        ranks.clear();
        positions.clear();
        while (!queue.empty() && queue.front().first == key) {
            const std::size_t r = queue.front().second;
            std::ranges::pop_heap(queue, std::greater{});
            queue.pop_back();
            ranks.push_back(static_cast<std::int32_t>(r));
            positions.push_back(static_cast<std::uint32_t>(next[r]++));
        }
        if (ranks.size() > 1) meet(ranks, positions);
        for (const std::int32_t r : ranks) enqueue(static_cast<std::size_t>(r));
    }
}

/// Collective, within a transaction. Returns for each of this process's keys, which ascend and are
/// distinct, the other processes that have it, too; ascending by key and rank. A key is a vertex,
/// or the vertices of an edge or face, by global numbers, ascending.
///
/// Equal keys are sent to the same rendezvous process, which a hash determines. Memory and messages
/// are proportional to the number of keys, and evenly distributed.
template <std::size_t N>
[[nodiscard]] std::vector<Sharer> find_sharers(
    const Communicator& processes, const std::vector<std::array<std::uint64_t, N>>& keys) {
    using Key = std::array<std::uint64_t, N>;
    const auto process_count = static_cast<std::size_t>(processes.size());
    const auto rendezvous_of = [&](const Key& key) {
        std::uint64_t h = 0;
        for (const std::uint64_t k : key) h = (h ^ k) * 0x9e3779b97f4a7c15U;
        return (h >> 32U) % process_count;
    };

    std::vector<std::vector<Key>> outboxes(process_count);
    std::vector<std::vector<std::uint32_t>> numbers(process_count);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::size_t rendezvous = rendezvous_of(keys[i]);
        outboxes[rendezvous].push_back(keys[i]);
        numbers[rendezvous].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::vector<Sharer>> replies(process_count);
    for_each_common(processes.all_to_all(outboxes), [&](const auto& ranks, const auto& positions) {
        for (std::size_t i = 0; i < ranks.size(); ++i) {
            for (const std::int32_t other : ranks) {
                if (other == ranks[i]) continue;
                replies[static_cast<std::size_t>(ranks[i])].push_back({positions[i], other});
            }
        }
    });
    const auto answers = processes.all_to_all(replies);
    std::vector<Sharer> sharers;
    for (std::size_t r = 0; r < process_count; ++r) {
        for (const Sharer& s : answers[r]) sharers.push_back({numbers[r][s.key], s.rank});
    }
    std::ranges::sort(sharers);
    return sharers;
}

}  // namespace octetra::distributed
