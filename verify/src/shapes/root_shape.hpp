#pragma once

#include <array>
#include <string>

#include <octetra/core/point.hpp>

#include "shapes/integers.hpp"

namespace octetra::verify::shapes {

/// Three vectors: from the lexicographically least corner of a cell to the others, which ascend
/// lexicographically; x, y, z of each.
template <class Int>
using Vectors = std::array<Int, 9>;

/// A cell up to translation and scaling: vectors whose nine coordinates have no common divisor.
/// Equal for two cells if and only if a translation and a positive scaling maps one to the other.
struct RootShape {
    Vectors<BigInt> vectors{};  ///< empty numbers if `small` is used
    Vectors<std::int64_t> small{};
    bool is_small = false;  ///< whether coordinates are less than 2^60
};

/// Returns the shape of a cell with finite coordinates and distinct corners.
[[nodiscard]] RootShape root_shape(std::array<Point, 4> corners);

/// Returns bytes that are equal for equal shapes only.
[[nodiscard]] std::string bytes_of(const RootShape& root);

/// Converts the coordinates to integers that hold them.
template <class Int>
[[nodiscard]] Vectors<Int> vectors_of(const RootShape& root) {
    Vectors<Int> vectors;
    for (std::size_t k = 0; k < 9; ++k) {
        vectors[k] =
            root.is_small ? static_cast<Int>(root.small[k]) : static_cast<Int>(root.vectors[k]);
    }
    return vectors;
}

/// Returns six times the volume.
[[nodiscard]] BigInt six_volumes(const RootShape& root);

}  // namespace octetra::verify::shapes
