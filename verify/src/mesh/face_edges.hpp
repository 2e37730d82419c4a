#pragma once

#include <array>
#include <cstdint>

namespace octetra::verify {

/// The edges of each face of a cell, as positions in cell_edges; face i is opposite corner i.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_edges{
    {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};

}  // namespace octetra::verify
