#pragma once

#include <algorithm>
#include <cstdint>

#include <octetra/core/mesh_source.hpp>

namespace octetra {

/// Calls take(window) for windows that together cover all slices of a larger one, `length` entities
/// of each slice at a time, so that the buffers of a MeshSource remain small.
void for_each_piece(const Window& slices, std::uint64_t length, auto&& take) {
    Window piece = slices;
    if (piece.distance == 0) piece.distance = slices.slice_length;
    for (std::uint64_t done = 0; done < slices.slice_length; done += length) {
        piece.begin = slices.begin + done;
        piece.slice_length = std::min(length, slices.slice_length - done);
        take(static_cast<const Window&>(piece));
    }
}

}  // namespace octetra
