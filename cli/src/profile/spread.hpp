#pragma once

#include <algorithm>
#include <vector>

namespace octetra::cli {

/// Statistics of a figure over ranks; all 0 if there are no ranks.
template <class T>
struct Spread {
    T min{};
    T max{};
    T sum{};
    double mean = 0;
};

template <class T>
[[nodiscard]] Spread<T> spread(const std::vector<T>& of_rank) {
    Spread<T> result;
    if (of_rank.empty()) return result;
    result.min = *std::ranges::min_element(of_rank);
    result.max = *std::ranges::max_element(of_rank);
    for (const T value : of_rank) result.sum += value;
    result.mean = static_cast<double>(result.sum) / static_cast<double>(of_rank.size());
    return result;
}

/// Returns `member` of each rank.
template <class T, class M>
[[nodiscard]] std::vector<M> each(const std::vector<T>& of_rank, M T::*member) {
    std::vector<M> values;
    values.reserve(of_rank.size());
    for (const T& of_one : of_rank) values.push_back(of_one.*member);
    return values;
}

}  // namespace octetra::cli
