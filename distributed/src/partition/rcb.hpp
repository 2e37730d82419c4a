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

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Where a cell is: the mean of its corners, as rounding makes it in their order, which is sooner
/// found than what is a matter of the corners alone.
[[nodiscard]] inline Point place_of(const Corners& corners) {
    const auto mean = [](double a, double b, double c, double d) {
        return (a / 4 + b / 4) + (c / 4 + d / 4);  // does not overflow
    };
    const auto& [a, b, c, d] = corners;
    return {mean(a.x, b.x, c.x, d.x), mean(a.y, b.y, c.y, d.y), mean(a.z, b.z, c.z, d.z)};
}

/// What is to be shared out: a cell, as its place.
struct WeighedPoint {
    Point point;
    std::uint64_t number = 0;  ///< in the whole mesh: decides where points are equal
    std::uint64_t weight = 1;
};

/// The same of many, by place, as they are to be had. Kept of them are 12 bytes
/// for each, and 8 more where coordinates are equal.
struct WeighedPoints {
    std::size_t count = 0;
    /// Writes as many points as there is room for, from one on. All are asked for once for each
    /// level of the tree, in order, and a few again.
    std::function<void(std::size_t first, std::span<Point> points)> points;
    std::function<std::uint64_t(std::size_t)> number;
    std::function<std::uint64_t(std::size_t)> weight;  ///< or none: each weighs 1
};

/// A weight as a whole number, the least of all, which is `least`, a thousand. Both are positive
/// and finite; what is more than a million times the least is as much as that.
[[nodiscard]] inline std::uint64_t whole_weight(float weight, float least) {
    constexpr double most = 0x1p+30;  // the sum of 2^32 of them is to fit
    return static_cast<std::uint64_t>(
        std::min(most, 1000.0 * static_cast<double>(weight) / static_cast<double>(least)));
}

/// Collective. Recursive coordinate bisection: boxes are cut across their longest extent, the last
/// of those within a 64th of it, into two whose weights are as their numbers of parts, until each
/// is one part. Returns the part, 0 to parts-1, of each of this process's points. All is done in
/// whole numbers, so the parts are the same however many processes find them, and whichever has
/// which points. Weights add up to less than 2^63.
///
/// Of each level of the tree, processes reduce the extent of each box, then arrays of sums, one a
/// digit, of 2^13 numbers for all boxes together or four for each, until 2^11 points or fewer may
/// be at a limit, and these: some six reductions, more where many coordinates are equal. Where a
/// process has failed or fails, the result is not to be used on any.
[[nodiscard]] std::vector<int> bisect_coordinates(const Communicator& processes,
                                                  const WeighedPoints& points, int parts,
                                                  LocalFailure& failure);
[[nodiscard]] std::vector<int> bisect_coordinates(const Communicator& processes,
                                                  const std::vector<WeighedPoint>& points,
                                                  int parts, LocalFailure& failure);

}  // namespace octetra::distributed
