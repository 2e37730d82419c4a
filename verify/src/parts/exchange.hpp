#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

#include <octetra/core/process_group.hpp>

/// ProcessGroup::exchange in terms of values. All functions here are collective.
namespace octetra::verify {

template <class T>
[[nodiscard]] ProcessGroup::Bytes bytes_of(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes bytes(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <class T>
[[nodiscard]] std::vector<T> values_of(const ProcessGroup::Bytes& bytes) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

/// Sends to_each[r] to process r; element [r] of the result was received from there. Frees sent
/// data.
template <class T>
[[nodiscard]] std::vector<std::vector<T>> exchange(const ProcessGroup& group,
                                                   std::vector<std::vector<T>> to_each) {
    std::vector<ProcessGroup::Bytes> outboxes;
    outboxes.reserve(to_each.size());
    for (std::vector<T>& values : to_each) {
        outboxes.push_back(bytes_of(values));
        values = {};
    }
    std::vector<std::vector<T>> received;
    received.reserve(to_each.size());
    for (ProcessGroup::Bytes& bytes : group.exchange(std::move(outboxes))) {
        received.push_back(values_of<T>(bytes));
        bytes = {};
    }
    return received;
}

/// Returns the values of all processes, by rank.
template <class T>
[[nodiscard]] std::vector<std::vector<T>> share_with_all(const ProcessGroup& group,
                                                         const std::vector<T>& values) {
    std::vector<std::vector<T>> of_all;
    for (const ProcessGroup::Bytes& bytes : group.of_all(bytes_of(values))) {
        of_all.push_back(values_of<T>(bytes));
    }
    return of_all;
}

/// Reduces the values of all processes, in the order of ranks.
template <class T>
[[nodiscard]] T reduce(const ProcessGroup& group, T value, auto&& combine) {
    if (group.size() == 1) return value;
    const auto all = share_with_all(group, std::vector<T>{value});
    T result = all.front().front();
    for (std::size_t r = 1; r < all.size(); ++r) result = combine(result, all[r].front());
    return result;
}

[[nodiscard]] inline std::uint64_t sum(const ProcessGroup& group, std::uint64_t number) {
    return reduce(group, number, std::plus<>());
}

[[nodiscard]] inline bool any(const ProcessGroup& group, bool here) {
    return sum(group, here ? 1 : 0) > 0;
}

template <class T>
[[nodiscard]] T greatest(const ProcessGroup& group, T value) {
    return reduce(group, value, [](T a, T b) { return std::max(a, b); });
}

}  // namespace octetra::verify
