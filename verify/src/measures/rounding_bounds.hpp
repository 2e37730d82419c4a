#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "refinement/descent.hpp"

/// Bounds for rounded vertices. If no midpoint had been rounded, the pieces of a cell would have
/// its volume and those of a face its vector area, exactly. A vertex deviates by at most `rounding`
/// in each coordinate, so by eta = sqrt(3) rounding, and an edge, as a vector, by 2 eta. Let L be
/// the length of the longest edge. Since a determinant is at most the product of the lengths of its
/// rows, six times a volume deviates by at most 3 * 2 eta (L + 2 eta)^2, and each component of a
/// vector area (as a cross product) by 2 * 2 eta (L + 2 eta). These bounds are summed over the
/// pieces and rounded up.
namespace octetra::verify {

/// A type for bounds, which are products of three lengths and must neither under- nor overflow.
using Bound = long double;
static_assert(std::numeric_limits<Bound>::max_exponent >
                  4 * std::numeric_limits<double>::max_exponent &&
              std::numeric_limits<Bound>::min_exponent <
                  4 * std::numeric_limits<double>::min_exponent);
inline constexpr Bound up = 1 + 1e-9L;  // exceeds all rounding errors of the bounds together

template <std::size_t N>
struct Shape {
    std::array<Point, N> corners;
    double rounding = 0;  ///< maximum over the corners

    [[nodiscard]] Bound longest_edge() const {
        Bound longest_squared = 0;
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                const Bound x = Bound{corners[i].x} - corners[k].x;
                const Bound y = Bound{corners[i].y} - corners[k].y;
                const Bound z = Bound{corners[i].z} - corners[k].z;
                longest_squared = std::max(longest_squared, x * x + y * y + z * z);
            }
        }
        return std::sqrt(longest_squared);
    }
    [[nodiscard]] Bound edge_error() const { return 2 * std::sqrt(Bound{3}) * rounding; }
};

template <std::size_t N>
[[nodiscard]] Shape<N> shape_of(const std::array<VertexIndex, N>& vertices, const Mesh& fine,
                                const Descent& descent) {
    Shape<N> shape;
    for (std::size_t k = 0; k < N; ++k) {
        shape.corners[k] = fine.points[vertices[k]];
        shape.rounding = std::max(shape.rounding, descent.rounding[vertices[k]]);
    }
    return shape;
}

[[nodiscard]] inline Bound volume_bound(const Shape<4>& shape) {
    if (shape.rounding == 0) return 0;
    const Bound length = shape.longest_edge() + shape.edge_error();
    return 3 * shape.edge_error() * length * length * up;
}

[[nodiscard]] inline Bound area_bound(const Shape<3>& shape) {
    if (shape.rounding == 0) return 0;
    return 2 * shape.edge_error() * (shape.longest_edge() + shape.edge_error()) * up;
}

}  // namespace octetra::verify
