#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <octetra/core/point.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Returns the position of a cell: the mean of its corners, with rounding that depends on their
/// order, which is cheaper than an order-independent mean.
[[nodiscard]] inline Point centroid_of(const Corners& corners) {
    const auto mean = [](double a, double b, double c, double d) {
        return (a / 4 + b / 4) + (c / 4 + d / 4);  // does not overflow
    };
    const auto& [a, b, c, d] = corners;
    return {mean(a.x, b.x, c.x, d.x), mean(a.y, b.y, c.y, d.y), mean(a.z, b.z, c.z, d.z)};
}

/// A cell to be assigned to a part, as a point.
struct WeighedPoint {
    Point point;
    std::uint64_t number = 0;  ///< global number; decides between equal points
    std::uint64_t weight = 1;
};

/// The points to be distributed, by index, as functions. Bisection stores 12 bytes for each, and 8
/// more if coordinates are equal.
struct WeighedPoints {
    std::size_t count = 0;
    /// Writes the points from `first` on to fill the span. All points are requested once for each
    /// level of the tree, in order, and a few once more.
    std::function<void(std::size_t first, std::span<Point> points)> points;
    std::function<std::uint64_t(std::size_t)> number;
    std::function<std::uint64_t(std::size_t)> weight;  ///< or empty: all weights are 1
};

/// Converts a weight to an integer, such that the smallest weight, `least`, becomes 1000. Both must
/// be positive and finite; weights above about a million times the least are reduced to that.
[[nodiscard]] inline std::uint64_t integer_weight(float weight, float least) {
    constexpr double most = 0x1p+30;  // so that the sum of 2^32 weights does not overflow
    return static_cast<std::uint64_t>(
        std::min(most, 1000.0 * static_cast<double>(weight) / static_cast<double>(least)));
}

/// Collective. Recursive coordinate bisection: boxes are divided across their longest extent, or
/// the last of those within 1/64 of it, into two boxes whose weights are proportional to their
/// numbers of parts, until each box is one part. Returns the part, 0 to parts-1, of each of this
/// process's points. All computations use integers, so the parts depend neither on the number of
/// processes nor on the distribution of the points. The sum of weights must be less than 2^63.
///
/// For each level of the tree, processes reduce the extent of each box, then arrays of sums, one
/// array per digit, of 2^13 numbers for all boxes together or of four for each, until at most 2^11
/// points may be at a limit, and then these points: about six exchanges, more if many coordinates
/// are equal.
[[nodiscard]] std::vector<int> bisect_coordinates(const Communicator& processes,
                                                  const WeighedPoints& points, int parts);
[[nodiscard]] std::vector<int> bisect_coordinates(const Communicator& processes,
                                                  const std::vector<WeighedPoint>& points,
                                                  int parts);

}  // namespace octetra::distributed
