#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Maps the entities of a list in a file to the processes that have read them, their owners. Each
/// process has read one block.
class OwnerMap {
public:
    OwnerMap() = default;

    /// `begins`: the number of the first entity of each process, followed by the number of all
    /// entities.
    explicit OwnerMap(std::vector<std::uint64_t> begins) : begins_(std::move(begins)) {}

    [[nodiscard]] std::uint64_t begin_of(int rank) const {
        return begins_[static_cast<std::size_t>(rank)];
    }
    [[nodiscard]] std::uint64_t end_of(int rank) const { return begin_of(rank + 1); }
    [[nodiscard]] int rank_of(std::uint64_t number) const {
        return static_cast<int>(std::ranges::upper_bound(begins_, number) - begins_.begin()) - 1;
    }

private:
    std::vector<std::uint64_t> begins_;
};

/// Returns the first block of a list that a process reads if the blocks are distributed evenly.
[[nodiscard]] inline std::uint64_t first_block_of(int rank, std::uint64_t blocks, int processes) {
    const auto r = static_cast<std::uint64_t>(rank);
    const auto count = static_cast<std::uint64_t>(processes);
    return blocks / count * r + std::min(blocks % count, r);
}

/// Returns the owners of a list whose blocks are distributed evenly.
[[nodiscard]] inline OwnerMap owners_of_blocks(std::uint64_t count, std::uint64_t block_length,
                                               int processes) {
    const std::uint64_t blocks = count / block_length + (count % block_length != 0 ? 1 : 0);
    std::vector<std::uint64_t> begins;
    for (int rank = 0; rank <= processes; ++rank) {
        begins.push_back(std::min(count, first_block_of(rank, blocks, processes) * block_length));
    }
    return OwnerMap(std::move(begins));
}

/// Collective. Returns the owners of blocks of which each process passes the first number.
[[nodiscard]] inline OwnerMap owners_of_shares(const Communicator& processes, std::uint64_t first,
                                               std::uint64_t count) {
    std::vector<std::uint64_t> begins(static_cast<std::size_t>(processes.size()) + 1, 0);
    begins[static_cast<std::size_t>(processes.rank())] = first;
    begins.back() = processes.is_first() ? count : 0;
    processes.sum(std::span(begins));
    return OwnerMap(std::move(begins));
}

/// Requests for entities of a list, by number, sent to their owners.
template <class Number = std::uint64_t>
struct Requests {
    /// To each owner, ascending; answers arrive in the same order.
    std::vector<std::vector<Number>> sent;
    /// From each process.
    std::vector<std::vector<Number>> received;
};

/// Collective, within a transaction. Sends the requests for `numbers`, which ascend.
template <class Number>
[[nodiscard]] Requests<Number> request(const Communicator& processes, const OwnerMap& owners,
                                       const std::vector<Number>& numbers) {
    Requests<Number> requests;
    requests.sent.resize(static_cast<std::size_t>(processes.size()));
    auto begin = numbers.begin();
    for (int rank = 0; rank < processes.size(); ++rank) {
        const auto end = std::partition_point(
            begin, numbers.end(), [&](Number number) { return number < owners.end_of(rank); });
        requests.sent[static_cast<std::size_t>(rank)].assign(begin, end);
        begin = end;
    }
    requests.received = processes.all_to_all(requests.sent);
    return requests;
}

/// Collective, within a transaction. Returns the requested values in the order of the numbers,
/// `components` for each.
/// `owned` are the values of the entities from number `first` on, which this process owns.
template <class T, class Number>
[[nodiscard]] std::vector<T> fetch(const Communicator& processes, const Requests<Number>& requests,
                                   const std::vector<T>& owned, std::uint64_t first,
                                   std::size_t components = 1) {
    std::vector<std::vector<T>> answers(requests.received.size());
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        answers[rank].reserve(requests.received[rank].size() * components);
        for (const Number number : requests.received[rank]) {
            const T* const values =
                owned.data() + static_cast<std::size_t>(number - first) * components;
            answers[rank].insert(answers[rank].end(), values, values + components);
        }
    }
    std::vector<std::vector<T>> received = processes.all_to_all(answers);
    answers.clear();
    std::size_t count = 0;
    for (const auto& answer : received) count += answer.size();
    std::vector<T> values;
    reserve_in_huge_pages(values, count);
    for (auto& answer : received) {
        values.insert(values.end(), answer.begin(), answer.end());
        std::vector<T>().swap(answer);
    }
    return values;
}

}  // namespace octetra::distributed
