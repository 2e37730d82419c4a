#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// The domain of a process: a box with low <= x < high in every coordinate. The boxes of all
/// processes tile space, so each vertex belongs to exactly one, and each edge, face and cell to
/// that of its lexicographically smallest corner. By default all of space.
struct Domain {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{-infinity, -infinity, -infinity};
    std::array<double, 3> high{infinity, infinity, infinity};
    bool is_everything = true;

    [[nodiscard]] bool owns(const Point& p) const {
        return is_everything || (low[0] <= p.x && p.x < high[0] && low[1] <= p.y && p.y < high[1] &&
                                 low[2] <= p.z && p.z < high[2]);
    }

    template <std::size_t N>
    [[nodiscard]] bool owns(const std::array<VertexIndex, N>& vertices,
                            const IndexVector<VertexIndex, Point>& points) const {
        return is_everything || owns(smallest_corner(vertices, points));
    }

    template <std::size_t N>
    [[nodiscard]] static const Point& smallest_corner(
        const std::array<VertexIndex, N>& vertices, const IndexVector<VertexIndex, Point>& points) {
        VertexIndex smallest = vertices[0];
        for (std::size_t k = 1; k < N; ++k) {
            if (points[vertices[k]] < points[smallest]) smallest = vertices[k];
        }
        return points[smallest];
    }
};

}  // namespace octetra::verify
