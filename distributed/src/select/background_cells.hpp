#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <octetra/core/box_tree.hpp>
#include <octetra/core/selection.hpp>

namespace octetra::distributed {

/// A cell of a background mesh, with its corners in ascending order and their values. Lengths are
/// in units in which the background mesh has an extent of about 1.
struct BackgroundCell {
    Corners corners;
    std::array<double, 4> values{};
};

/// The closest point of a background mesh: the squared distance to it, and its value. Of equally
/// close ones, the one with the least value is the closest.
struct ClosestValue {
    /// Rounded to 32 binary digits: cells with a common closest point have the same distance.
    double squared = std::numeric_limits<double>::infinity();
    double value = std::numeric_limits<double>::infinity();

    friend auto operator<=>(const ClosestValue&, const ClosestValue&) = default;
};

/// Returns the closest point of a cell, at the distance 0 if p is in it.
[[nodiscard]] ClosestValue closest_value(const Point& p, const BackgroundCell& cell);

/// The part of a background mesh that this process has.
class BackgroundCells {
public:
    /// `exponent`: the unit of length is 2^exponent.
    BackgroundCells(std::vector<BackgroundCell> cells, int exponent)
        : tree_(std::move(cells)), exponent_(exponent) {}

    [[nodiscard]] int exponent() const { return exponent_; }
    [[nodiscard]] std::vector<Box> boxes(std::size_t most) const { return tree_.boxes(most); }
    /// Returns the least of `bound` and the results of closest_value(), whatever the tree.
    [[nodiscard]] ClosestValue closest(const Point& p, ClosestValue bound = {}) const;

private:
    struct BoxOfCell {
        Box operator()(const BackgroundCell& cell) const;
    };

    BoxTree<BackgroundCell, BoxOfCell> tree_;
    int exponent_;
};

/// Returns a squared distance that is slightly greater than `squared`, whatever its rounding.
[[nodiscard]] constexpr double slightly_more(double squared) { return squared * (1 + 0x1p-30); }

}  // namespace octetra::distributed
