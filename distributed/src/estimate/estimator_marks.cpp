#include <octetra/distributed/estimator_marks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "estimate/exact_sum.hpp"
#include "estimate/ranked_indicators.hpp"

namespace octetra::distributed {
namespace {

/// The bits of the smallest positive double: the indicator of any marked cell is at least this.
constexpr std::uint64_t min_threshold = 1;

/// An argument between `least` and 1.
struct Parameter {
    const char* name;
    double value;
    double least;
    const char* range;
};

void check(const Parameter& parameter, double on_first, int rank) {
    const auto [name, value, least, range] = parameter;
    if (bits_of(value) < bits_of(least) || bits_of(value) > bits_of(1)) {
        throw InputError(
            fmt::format("rank {}: {} is {}, which is not in {}", rank, name, value, range));
    }
    if (bits_of(value) != bits_of(on_first)) {
        throw InputError(
            fmt::format("rank {}: {} is {}, and {} on rank 0", rank, name, value, on_first));
    }
}

void check(std::span<const double> indicators, int rank) {
    constexpr std::uint64_t greatest = bits_of(std::numeric_limits<double>::max());
    for (std::size_t c = 0; c < indicators.size(); ++c) {
        if (bits_of(indicators[c]) <= greatest) continue;
        throw InputError(
            fmt::format("rank {}: the indicator of cell {} is {}, where a finite "
                        "number of at least 0 is needed",
                        rank, c, indicators[c]));
    }
}

/// Collective. In a transaction, checks all arguments and performs `work`, which allocates all
/// memory. Nothing fails after it, so that reductions need no agreement.
void prepare(const Communicator& processes, std::span<const double> indicators,
             const Parameter& parameter, auto&& work) {
    processes.transaction([&] {
        check(parameter, processes.of_rank(0, parameter.value), processes.rank());
        check(indicators, processes.rank());
        work();
    });
}

/// The number of thresholds that are tried at once: with 15, each round determines four bits.
constexpr std::size_t trial_count = 15;
using Trials = std::array<std::uint64_t, trial_count>;

/// Returns the greatest threshold up to `high` that is low enough, or min_threshold if none is.
/// count_enough(trials) returns how many of the ascending trials are low enough: these are the
/// first ones.
std::uint64_t greatest_threshold(std::uint64_t high, auto&& count_enough) {
    std::uint64_t low = min_threshold;
    while (low < high) {
        const std::uint64_t step = (high - low) / (trial_count + 1) + 1;
        Trials trials{};
        for (std::size_t t = 0; t < trial_count; ++t) {
            trials[t] = std::min(low + (t + 1) * step, high);
        }
        const std::size_t enough = count_enough(trials);
        if (enough < trial_count) high = trials[enough] - 1;
        if (enough > 0) low = trials[enough - 1];
    }
    return low;
}

/// Collective. Returns for each threshold the sum over all processes of the indicators that are at
/// least this threshold.
std::array<ExactSum, trial_count> sums_from(const Trials& thresholds, const Communicator& processes,
                                            std::span<const std::uint64_t> descending,
                                            const RankedSums& sums) {
    std::array<std::uint64_t, trial_count * ExactSum::limb_count> limbs{};
    for (std::size_t t = 0; t < trial_count; ++t) {
        const ExactSum sum = sums.of_first(count_from(thresholds[t], descending));
        std::ranges::copy(sum.limbs(), limbs.begin() + t * ExactSum::limb_count);
    }
    processes.sum(limbs);
    std::array<ExactSum, trial_count> of_all;
    for (std::size_t t = 0; t < trial_count; ++t) {
        of_all[t] = ExactSum(std::span<const std::uint64_t, ExactSum::limb_count>(
            limbs.data() + t * ExactSum::limb_count, ExactSum::limb_count));
    }
    return of_all;
}

void mark_from(std::uint64_t threshold, std::span<const double> indicators,
               std::vector<std::uint8_t>& marks) {
    std::ranges::transform(indicators, marks.begin(), [&](double indicator) {
        return static_cast<std::uint8_t>(bits_of(indicator) >= threshold ? 1 : 0);
    });
}

}  // namespace

std::vector<std::uint8_t> mark_bulk(const Communicator& processes,
                                    std::span<const double> indicators, double theta) {
    const StandardArithmetic standard;
    std::vector<std::uint8_t> marks;
    std::vector<std::uint64_t> descending;
    std::optional<RankedSums> sums;
    const Parameter share{"theta", theta, std::numeric_limits<double>::denorm_min(), "(0, 1]"};
    prepare(processes, indicators, share, [&] {
        descending = descending_bits(indicators);
        sums.emplace(descending);
        marks.resize(indicators.size());
    });
    auto limbs = sums->of_first(descending.size()).limbs();
    processes.sum(limbs);
    const ExactSum total(limbs);
    if (total == ExactSum()) return marks;
    const ExactSum needed = total.share(theta);
    const auto greatest = processes.max(descending.empty() ? 0 : descending.front());
    const auto threshold = greatest_threshold(greatest, [&](const Trials& trials) {
        const auto of_all = sums_from(trials, processes, descending, *sums);
        return static_cast<std::size_t>(
            std::ranges::count_if(of_all, [&](const ExactSum& sum) { return sum >= needed; }));
    });
    mark_from(threshold, indicators, marks);
    return marks;
}

std::vector<std::uint8_t> mark_maximum(const Communicator& processes,
                                       std::span<const double> indicators, double share) {
    const StandardArithmetic standard;
    std::vector<std::uint8_t> marks;
    prepare(processes, indicators, {"share", share, 0, "[0, 1]"},
            [&] { marks.resize(indicators.size()); });
    std::uint64_t greatest = 0;
    for (const double indicator : indicators) greatest = std::max(greatest, bits_of(indicator));
    greatest = processes.max(greatest);
    const double product = share * std::bit_cast<double>(greatest);
    mark_from(std::max(bits_of(product), min_threshold), indicators, marks);
    return marks;
}

std::vector<std::uint8_t> mark_fraction(const Communicator& processes,
                                        std::span<const double> indicators, double fraction) {
    const StandardArithmetic standard;
    std::vector<std::uint8_t> marks;
    std::vector<std::uint64_t> descending;
    const Parameter share{"fraction", fraction, std::numeric_limits<double>::denorm_min(),
                          "(0, 1]"};
    prepare(processes, indicators, share, [&] {
        descending = descending_bits(indicators);
        marks.resize(indicators.size());
    });
    const std::uint64_t cells = processes.sum(indicators.size());
    const auto wanted =
        static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(cells)));
    const auto greatest = processes.max(descending.empty() ? 0 : descending.front());
    const auto threshold = greatest_threshold(greatest, [&](const Trials& trials) {
        Trials counts{};
        std::ranges::transform(trials, counts.begin(),
                               [&](std::uint64_t trial) { return count_from(trial, descending); });
        processes.sum(counts);
        return static_cast<std::size_t>(
            std::ranges::count_if(counts, [&](std::uint64_t count) { return count >= wanted; }));
    });
    mark_from(threshold, indicators, marks);
    return marks;
}

}  // namespace octetra::distributed
