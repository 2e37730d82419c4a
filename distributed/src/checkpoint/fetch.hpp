#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Which process has read which stretch of a list of a file: whole blocks, shared out evenly.
class Homes {
public:
    Homes(std::uint64_t count, std::uint64_t block_length, int processes)
        : count_(count),
          block_length_(block_length),
          blocks_((count + block_length - 1) / block_length),
          processes_(static_cast<std::uint64_t>(processes)) {}

    [[nodiscard]] std::uint64_t begin_of(int rank) const {
        return std::min(count_, first_block_of(rank) * block_length_);
    }
    [[nodiscard]] std::uint64_t end_of(int rank) const { return begin_of(rank + 1); }
    [[nodiscard]] std::uint64_t first_block_of(int rank) const {
        const auto r = static_cast<std::uint64_t>(rank);
        return blocks_ / processes_ * r + std::min(blocks_ % processes_, r);
    }
    [[nodiscard]] int rank_of(std::uint64_t number) const {
        int rank = 0;
        for (int step = 1 << 30; step > 0; step /= 2) {
            const int next = rank + step;
            if (next < static_cast<int>(processes_) && begin_of(next) <= number) rank = next;
        }
        return rank;
    }

private:
    std::uint64_t count_;
    std::uint64_t block_length_;
    std::uint64_t blocks_;
    std::uint64_t processes_;
};

/// Who wants which entities of a list, each asked for by its number at its home.
struct Requests {
    /// To each home, ascending: and so in the order in which answers come.
    std::vector<std::vector<std::uint64_t>> sent;
    /// From each process.
    std::vector<std::vector<std::uint64_t>> received;
};

/// Collective. `numbers` ascend.
[[nodiscard]] inline Requests request(const Communicator& processes, const Homes& homes,
                                      std::span<const std::uint64_t> numbers) {
    Requests requests;
    requests.sent.resize(static_cast<std::size_t>(processes.size()));
    for (int rank = 0; rank < processes.size(); ++rank) {
        const auto begin = std::ranges::lower_bound(numbers, homes.begin_of(rank));
        const auto end = std::ranges::lower_bound(numbers, homes.end_of(rank));
        requests.sent[static_cast<std::size_t>(rank)].assign(begin, end);
    }
    requests.received = processes.all_to_all(requests.sent);
    return requests;
}

/// Collective. What was asked for, in the order of the numbers: `components` for each. `home` are
/// the entities from number `first` on, which this process is the home of.
template <class T>
[[nodiscard]] std::vector<T> fetch(const Communicator& processes, const Requests& requests,
                                   const std::vector<T>& home, std::uint64_t first,
                                   std::size_t components = 1) {
    std::vector<std::vector<T>> answers(requests.received.size());
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        for (const std::uint64_t number : requests.received[rank]) {
            const auto begin = static_cast<std::size_t>(number - first) * components;
            answers[rank].insert(answers[rank].end(),
                                 home.begin() + static_cast<std::ptrdiff_t>(begin),
                                 home.begin() + static_cast<std::ptrdiff_t>(begin + components));
        }
    }
    std::vector<T> values;
    for (const auto& answer : processes.all_to_all(answers)) {
        values.insert(values.end(), answer.begin(), answer.end());
    }
    return values;
}

}  // namespace octetra::distributed
