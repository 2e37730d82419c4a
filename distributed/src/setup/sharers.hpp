#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Another process that has the same key.
struct Sharer {
    std::uint32_t key = 0;  ///< which of this process's keys
    std::int32_t rank = 0;

    friend auto operator<=>(const Sharer&, const Sharer&) = default;
};

/// Collective. For each of this process's keys, which are different from each other, the other
/// processes that have it too; ascending by key and rank. A key is a vertex, or the vertices of an
/// edge or face, by global numbers, ascending. None on any process, if one has failed or fails.
///
/// Each key meets its equals at a process that its value decides. Memory and messages are in
/// proportion to the keys, and evenly spread.
template <std::size_t N>
[[nodiscard]] std::vector<Sharer> find_sharers(
    const Communicator& processes, const std::vector<std::array<std::uint64_t, N>>& keys,
    LocalFailure& failure) {
    using Key = std::array<std::uint64_t, N>;
    struct Arrival {
        Key key;
        std::int32_t rank;
        std::uint32_t position;
    };
    const auto process_count = static_cast<std::size_t>(processes.size());
    const auto rendezvous_of = [&](const Key& key) {
        std::uint64_t h = 0;
        for (const std::uint64_t k : key) h = (h ^ k) * 0x9e3779b97f4a7c15U;
        return (h >> 32U) % process_count;
    };

    std::vector<std::vector<Key>> outboxes;
    std::vector<std::vector<std::uint32_t>> numbers;
    failure.attempt([&] {
        outboxes.resize(process_count);
        numbers.resize(process_count);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const std::size_t place = rendezvous_of(keys[i]);
            outboxes[place].push_back(keys[i]);
            numbers[place].push_back(static_cast<std::uint32_t>(i));
        }
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return {};

    std::vector<std::vector<Sharer>> replies;
    failure.attempt([&] {
        std::vector<Arrival> arrivals;
        const auto inboxes = processes.all_to_all(outboxes);
        for (std::size_t r = 0; r < process_count; ++r) {
            for (std::size_t i = 0; i < inboxes[r].size(); ++i) {
                arrivals.push_back(
                    {inboxes[r][i], static_cast<std::int32_t>(r), static_cast<std::uint32_t>(i)});
            }
        }
        std::ranges::sort(arrivals, {}, [](const Arrival& a) { return std::tie(a.key, a.rank); });
        replies.resize(process_count);
        for (std::size_t begin = 0, end = 0; begin < arrivals.size(); begin = end) {
            while (end < arrivals.size() && arrivals[end].key == arrivals[begin].key) ++end;
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t j = begin; j < end; ++j) {
                    if (i == j) continue;
                    replies[static_cast<std::size_t>(arrivals[i].rank)].push_back(
                        {arrivals[i].position, arrivals[j].rank});
                }
            }
        }
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return {};

    std::vector<Sharer> sharers;
    failure.attempt([&] {
        const auto answers = processes.all_to_all(replies);
        for (std::size_t r = 0; r < process_count; ++r) {
            for (const Sharer& s : answers[r]) sharers.push_back({numbers[r][s.key], s.rank});
        }
        std::ranges::sort(sharers);
    });
    return sharers;
}

}  // namespace octetra::distributed
