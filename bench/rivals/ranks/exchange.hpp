#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/core/process_group.hpp>

/// Communication between ranks in terms of vectors. Both functions are collective.
namespace octetra::rivals {

/// Sends to_each[r] to rank r; element r of the result was received from rank r.
template <class T>
std::vector<std::vector<T>> all_to_all(const ProcessGroup& ranks,
                                       const std::vector<std::vector<T>>& to_each) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<ProcessGroup::Bytes> bytes;
    for (const std::vector<T>& values : to_each) {
        const auto* const begin = reinterpret_cast<const std::byte*>(values.data());
        bytes.emplace_back(begin, begin + values.size() * sizeof(T));
    }
    std::vector<std::vector<T>> from_each;
    for (const ProcessGroup::Bytes& received : ranks.exchange(std::move(bytes))) {
        std::vector<T>& values = from_each.emplace_back(received.size() / sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), received.data(), received.size());
    }
    return from_each;
}

/// Runs `work`, which must not be collective, on every rank. Throws the InputError of the lowest
/// rank that failed on all ranks.
inline void on_each(const ProcessGroup& ranks, const std::function<void()>& work) {
    std::string failure;
    try {
        work();
    } catch (const InputError& error) {
        failure = error.what();
    }
    if (ranks.sum(std::uint64_t{failure.empty() ? 0U : 1U}) == 0) return;
    const std::vector<char> words(failure.begin(), failure.end());
    const std::vector<std::vector<char>> to_each(static_cast<std::size_t>(ranks.size()), words);
    for (const std::vector<char>& received : all_to_all(ranks, to_each)) {
        if (!received.empty()) throw InputError(std::string(received.begin(), received.end()));
    }
}

}  // namespace octetra::rivals
