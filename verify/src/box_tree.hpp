#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <octetra/core/point.hpp>

namespace octetra::verify {

/// A box with sides along the axes, closed; empty until it takes a point in.
struct Bounds {
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    void take(const Point& p) {
        const std::array<double, 3> at{p.x, p.y, p.z};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
        }
    }
    void take(const Bounds& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], b.low[k]);
            high[k] = std::max(high[k], b.high[k]);
        }
    }
    [[nodiscard]] bool meets(const Bounds& b) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (low[k] > b.high[k] || b.low[k] > high[k]) return false;
        }
        return true;
    }
};

template <std::size_t N>
[[nodiscard]] Bounds bounds_of(const std::array<Point, N>& points) {
    Bounds b;
    for (const Point& p : points) b.take(p);
    return b;
}

/// Boxes, findable by what they meet: a binary tree, cut at the median of the longer side.
class BoxTree {
public:
    explicit BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        if (!boxes_.empty()) build(0, boxes_.size());
    }

    /// Calls visit(i) for each box i that meets `wanted`.
    void for_each_meeting(const Bounds& wanted, auto&& visit) const {
        if (!nodes_.empty()) descend(0, 0, boxes_.size(), wanted, visit);
    }

private:
    static constexpr std::size_t leaf_size = 8;

    /// Nodes stand in the order of a walk: a node, its first half, its second half.
    struct Node {
        Bounds bounds;
        std::size_t second = 0;
    };

    std::size_t build(std::size_t first, std::size_t last) {
        const std::size_t node = nodes_.size();
        nodes_.emplace_back();
        Bounds bounds;
        for (std::size_t i = first; i < last; ++i) bounds.take(boxes_[order_[i]]);
        nodes_[node].bounds = bounds;
        if (last - first > leaf_size) {
            std::size_t axis = 0;
            const auto side = [&](std::size_t k) { return bounds.high[k] - bounds.low[k]; };
            for (std::size_t k = 1; k < 3; ++k) axis = side(k) > side(axis) ? k : axis;
            const std::size_t middle = first + (last - first) / 2;
            const auto at = [&](std::size_t i) {
                return order_.begin() + static_cast<std::ptrdiff_t>(i);
            };
            std::nth_element(at(first), at(middle), at(last), [&](auto i, auto j) {
                const auto centre = [&](auto b) {  // halved first: the sum could overflow
                    return boxes_[b].low[axis] / 2 + boxes_[b].high[axis] / 2;
                };
                return centre(i) < centre(j);
            });
            build(first, middle);
            const std::size_t second = build(middle, last);
            nodes_[node].second = second;
        }
        return node;
    }

    void descend(std::size_t node, std::size_t first, std::size_t last, const Bounds& wanted,
                 auto&& visit) const {
        if (!nodes_[node].bounds.meets(wanted)) return;
        if (last - first <= leaf_size) {
            for (std::size_t i = first; i < last; ++i) {
                if (boxes_[order_[i]].meets(wanted)) visit(order_[i]);
            }
            return;
        }
        const std::size_t middle = first + (last - first) / 2;
        descend(node + 1, first, middle, wanted, visit);
        descend(nodes_[node].second, middle, last, wanted, visit);
    }

    std::vector<Bounds> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace octetra::verify
