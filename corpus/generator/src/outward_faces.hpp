#pragma once

#include <array>
#include <cstdint>

namespace octetra::generator {

/// The faces of a positively oriented cell, as local positions of their corners, counterclockwise
/// as seen from outside. Face i is opposite corner i.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> outward_faces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace octetra::generator
