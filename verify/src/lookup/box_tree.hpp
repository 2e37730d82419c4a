#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <octetra/core/point.hpp>

namespace octetra::verify {

/// A closed axis-aligned box; empty until it is extended by a point.
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
            if (b.low[k] > high[k] || low[k] > b.high[k]) return false;
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

/// A set of boxes searchable by intersection: a binary tree, split at the median.
class BoxTree {
public:
    /// The axis along which a node is split: its longest side, or the axis along which its boxes
    /// overlap least relative to their widths, which is slower to build, but pays off if boxes are
    /// long and thin.
    enum class Cut : std::uint8_t { longest_side, most_room };

    explicit BoxTree(std::vector<Bounds> boxes, Cut cut = Cut::longest_side)
        : boxes_(std::move(boxes)), order_(boxes_.size()), cut_(cut) {
        std::iota(order_.begin(), order_.end(), 0U);
        if (!boxes_.empty()) build(0, boxes_.size());
    }

    /// Calls visit(i) for each box i that meets `wanted`: another box, or an object with a function
    /// meets(box) that is true for every box containing one for which it is true.
    void for_each_meeting(const auto& wanted, auto&& visit) const {
        for (std::size_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            if (!wanted.meets(node.bounds)) {
                n = node.after;
                continue;
            }
            for (std::size_t i = node.first; i < node.last; ++i) {
                if (wanted.meets(boxes_[order_[i]])) visit(order_[i]);
            }
            ++n;
        }
    }

private:
    static constexpr std::size_t leaf_size = 8;

    /// Nodes in depth-first order: a node, its first half, its second half.
    struct Node {
        Bounds bounds;
        std::uint32_t after = 0;  ///< the node after it and its halves
        std::uint32_t first = 0;  ///< range in order_, for a leaf
        std::uint32_t last = 0;
    };

    void build(std::size_t first, std::size_t last) {
        const std::size_t node = nodes_.size();
        nodes_.emplace_back();
        Bounds bounds;
        for (std::size_t i = first; i < last; ++i) bounds.take(boxes_[order_[i]]);
        nodes_[node].bounds = bounds;
        if (last - first > leaf_size) {
            const std::size_t axis = axis_to_cut(first, last, bounds);
            const std::size_t middle = first + (last - first) / 2;
            const auto at = [&](std::size_t i) {
                return order_.begin() + static_cast<std::ptrdiff_t>(i);
            };
            std::nth_element(at(first), at(middle), at(last), [&](auto i, auto j) {
                const auto centre = [&](auto b) {  // halved first, since the sum could overflow
                    return boxes_[b].low[axis] / 2 + boxes_[b].high[axis] / 2;
                };
                return centre(i) < centre(j);
            });
            build(first, middle);
            build(middle, last);
        } else {
            nodes_[node].first = static_cast<std::uint32_t>(first);
            nodes_[node].last = static_cast<std::uint32_t>(last);
        }
        nodes_[node].after = static_cast<std::uint32_t>(nodes_.size());
    }

    [[nodiscard]] std::size_t axis_to_cut(std::size_t first, std::size_t last,
                                          const Bounds& bounds) const {
        std::array<double, 3> widths{};  // sums over the boxes
        if (cut_ == Cut::most_room) {
            for (std::size_t i = first; i < last; ++i) {
                const Bounds& box = boxes_[order_[i]];
                for (std::size_t k = 0; k < 3; ++k) widths[k] += box.high[k] - box.low[k];
            }
        }
        std::size_t axis = 0;
        const auto side = [&](std::size_t k) { return bounds.high[k] - bounds.low[k]; };
        const auto has_more_room = [&](std::size_t i, std::size_t k) {
            return cut_ == Cut::most_room ? side(i) * widths[k] > side(k) * widths[i]
                                          : side(i) > side(k);
        };
        for (std::size_t k = 1; k < 3; ++k) axis = has_more_room(k, axis) ? k : axis;
        return axis;
    }

    std::vector<Bounds> boxes_;
    std::vector<std::uint32_t> order_;
    Cut cut_;
    std::vector<Node> nodes_;
};

}  // namespace octetra::verify
