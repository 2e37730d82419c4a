#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Vertices by global numbers: the two ends of an edge, lower first, or the three of a face.
template <std::size_t N>
using NumberTuple = std::array<std::uint64_t, N>;

/// Tuples by who is to put them in order: processes answer for blocks of lowest numbers. The tuples
/// are ascending in these.
template <std::size_t N>
std::vector<std::vector<NumberTuple<N>>> by_process(const Communicator& processes,
                                                    const std::vector<NumberTuple<N>>& tuples,
                                                    std::uint64_t block) {
    std::vector<std::vector<NumberTuple<N>>> questions(static_cast<std::size_t>(processes.size()));
    auto begin = tuples.begin();
    for (std::size_t r = 0; r < questions.size(); ++r) {
        const auto end = std::partition_point(
            begin, tuples.end(),
            [&](const NumberTuple<N>& tuple) { return tuple[0] / block == r; });
        questions[r].assign(begin, end);
        begin = end;
    }
    return questions;
}

/// The different tuples among those asked for, in ascending order. Put there by counting, as few
/// have lowest numbers close to each other; there are no more bins than tuples, however far their
/// lowest numbers are apart.
template <std::size_t N>
class OrderedTuples {
public:
    explicit OrderedTuples(const std::vector<std::vector<NumberTuple<N>>>& asked) {
        find_bins(asked);
        for_each(asked, [&](const NumberTuple<N>& tuple) { ++begin_[bin_of(tuple)]; });
        std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
        // Filled from behind, after which every beginning is where it belongs.
        for_each(asked,
                 [&](const NumberTuple<N>& tuple) { tuples_[--begin_[bin_of(tuple)]] = tuple; });
        std::uint64_t count = 0;
        for (std::size_t bin = 0; bin + 1 < begin_.size(); ++bin) {
            const std::uint64_t begin = begin_[bin];
            const std::uint64_t end = begin_[bin + 1];
            std::sort(tuples_.data() + begin, tuples_.data() + end);
            begin_[bin] = count;
            for (std::uint64_t k = begin; k < end; ++k) {
                if (count > begin_[bin] && tuples_[count - 1] == tuples_[k]) continue;
                tuples_[count++] = tuples_[k];
            }
        }
        begin_.back() = count;
        tuples_.resize(count);
    }

    [[nodiscard]] std::uint64_t size() const { return tuples_.size(); }

    /// The place of a tuple that is there.
    [[nodiscard]] std::uint64_t place_of(const NumberTuple<N>& tuple) const {
        const std::size_t bin = bin_of(tuple);
        const auto* const found =
            std::lower_bound(tuples_.data() + begin_[bin], tuples_.data() + begin_[bin + 1], tuple);
        return static_cast<std::uint64_t>(found - tuples_.data());
    }

private:
    static void for_each(const std::vector<std::vector<NumberTuple<N>>>& asked, auto&& visit) {
        for (const auto& from_one : asked) std::ranges::for_each(from_one, visit);
    }
    void find_bins(const std::vector<std::vector<NumberTuple<N>>>& asked) {
        std::uint64_t count = 0;
        std::uint64_t last = 0;
        least_ = std::numeric_limits<std::uint64_t>::max();
        for (const auto& from_one : asked) {
            if (from_one.empty()) continue;
            count += from_one.size();
            least_ = std::min(least_, from_one.front()[0]);
            last = std::max(last, from_one.back()[0]);
        }
        tuples_.resize(count);
        if (count == 0) return begin_.assign(1, 0);
        while ((last - least_) >> shift_ >= count) ++shift_;
        begin_.assign(((last - least_) >> shift_) + 2, 0);
    }
    [[nodiscard]] std::size_t bin_of(const NumberTuple<N>& tuple) const {
        return (tuple[0] - least_) >> shift_;
    }

    std::uint64_t least_ = 0;  ///< lowest number
    unsigned shift_ = 0;
    std::vector<std::uint64_t> begin_;  ///< by bin
    std::vector<NumberTuple<N>> tuples_;
};

/// Collective. The places of tuples among the different tuples of all processes, in ascending
/// order, counted from `total`, to which it adds their number. `tuples` makes this process's, which
/// are ascending in their lowest numbers, and these less than `end_count`. Where a process fails
/// there is no result on any.
template <std::size_t N>
[[nodiscard]] std::vector<std::uint64_t> ranked(const Communicator& processes, auto&& tuples,
                                                std::uint64_t end_count, std::uint64_t& total,
                                                LocalFailure& failure) {
    const auto somewhere_failed = [&] {
        return failure.max_unless_failed(processes, 0) == LocalFailure::somewhere;
    };
    const auto process_count = static_cast<std::uint64_t>(processes.size());
    const std::uint64_t block = end_count / process_count + 1;
    std::vector<std::vector<NumberTuple<N>>> asked;
    failure.attempt([&] { asked = by_process<N>(processes, tuples(), block); });
    if (somewhere_failed()) return {};

    std::optional<OrderedTuples<N>> known;
    failure.attempt([&] {
        asked = processes.all_to_all(asked);
        known.emplace(asked);
    });
    const std::uint64_t count = known ? known->size() : 0;
    const std::uint64_t first = total + processes.sum_before(count);
    total += processes.sum(count);

    std::vector<std::vector<std::uint64_t>> answers;
    failure.attempt([&] {
        answers.resize(asked.size());
        for (std::size_t r = 0; r < asked.size(); ++r) {
            answers[r].reserve(asked[r].size());
            for (const NumberTuple<N>& tuple : asked[r])
                answers[r].push_back(first + known->place_of(tuple));
            asked[r] = {};
        }
    });
    if (somewhere_failed()) return {};
    // The tuples were ascending in their lowest numbers, so the answers come in their order.
    std::vector<std::uint64_t> places;
    failure.attempt([&] {
        for (const auto& from_one : processes.all_to_all(answers)) {
            places.insert(places.end(), from_one.begin(), from_one.end());
        }
    });
    return places;
}

}  // namespace octetra::distributed
