#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace octetra {

/// Returns {take(), take(), ...}, N results in order. Element-wise stores into an array that is
/// then loaded as a whole would stall for as long as parsing a number takes.
template <std::size_t N>
[[nodiscard]] auto taken_in_order(auto&& take) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return std::array{(static_cast<void>(k), take())...};
    }
    (std::make_index_sequence<N>());
}

}  // namespace octetra
