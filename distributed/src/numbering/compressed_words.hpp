#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/cut_runs.hpp>

namespace octetra::distributed {

using CompressedWords = std::vector<std::uint8_t>;

/// Compresses words for a message: each is encoded as its difference to the word before the
/// previous one, as a variable-length signed number. Every other word, or every word, ascends in
/// small steps.
[[nodiscard]] inline CompressedWords compressed(std::span<const std::uint64_t> words) {
    CompressedWords bytes;
    bytes.reserve(2 * words.size());
    std::array<std::uint64_t, 2> last{};
    for (const std::uint64_t word : words) {
        const std::uint64_t difference = word - last[0];
        const std::uint64_t sign = difference >> 63U;
        append_number((difference << 1U) ^ (0 - sign), bytes);
        last = {last[1], word};
    }
    return bytes;
}

[[nodiscard]] inline std::vector<std::uint64_t> decompressed(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint64_t> words;
    words.reserve(bytes.size());
    std::array<std::uint64_t, 2> last{};
    while (!bytes.empty()) {
        std::uint64_t number = 0;
        (void)take_number(bytes, number);
        const std::uint64_t word = last[0] + ((number >> 1U) ^ (0 - (number & 1U)));
        words.push_back(word);
        last = {last[1], word};
    }
    return words;
}

/// Converts the message to each process, or from each.
template <class From>
[[nodiscard]] auto of_each(const std::vector<From>& messages, auto&& convert) {
    std::vector<decltype(convert(std::span(messages.front())))> converted;
    converted.reserve(messages.size());
    for (const From& message : messages) converted.push_back(convert(std::span(message)));
    return converted;
}

}  // namespace octetra::distributed
