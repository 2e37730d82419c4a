#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <octetra/core/process_group.hpp>

namespace octetra {

/// Collective. Returns the lists of all processes, by rank.
template <class T>
[[nodiscard]] std::vector<std::vector<T>> gather_lists(const ProcessGroup& group,
                                                       std::span<const T> list) {
    static_assert(std::is_trivially_copyable_v<T>);
    ProcessGroup::Bytes own(list.size_bytes());
    if (!list.empty()) std::memcpy(own.data(), list.data(), own.size());
    std::vector<std::vector<T>> lists;
    for (const ProcessGroup::Bytes& bytes : group.of_all(std::move(own))) {
        std::vector<T>& other = lists.emplace_back(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(other.data(), bytes.data(), bytes.size());
    }
    return lists;
}

/// Collective. Returns the values of all processes, by rank.
template <class T>
[[nodiscard]] std::vector<T> gather(const ProcessGroup& group, const T& value) {
    std::vector<T> values;
    for (const auto& list : gather_lists(group, std::span(&value, 1))) {
        values.push_back(list.front());
    }
    return values;
}

}  // namespace octetra
