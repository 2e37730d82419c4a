#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

namespace octetra::cli {

/// A value of an option and its meaning.
template <class T>
using Word = std::pair<std::string_view, T>;

/// Returns the meaning of `text` as the value of `option`. Throws InputError, which lists the valid
/// words.
template <class T, std::size_t N>
[[nodiscard]] T parse_choice(std::string_view option, const std::string& text,
                             const std::array<Word<T>, N>& words) {
    std::string names;
    for (const auto& [word, meaning] : words) {
        if (text == word) return meaning;
        names += names.empty() ? "" : ", ";
        names += word;
    }
    throw InputError(fmt::format("{} takes one of {}, not '{}'", option, names, text));
}

}  // namespace octetra::cli
