#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace octetra {

/// {take(), take(), ...}: N of them, taken in order. Written one by one into an array, they would
/// be waited for where the array is then read as a whole, which takes as long as parsing one.
template <std::size_t N>
[[nodiscard]] auto taken_in_order(auto&& take) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return std::array{(static_cast<void>(k), take())...};
    }
    (std::make_index_sequence<N>());
}

}  // namespace octetra
