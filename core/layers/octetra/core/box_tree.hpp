#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/point.hpp>
#include <octetra/core/selection.hpp>

namespace octetra {

/// The squared distance to the closest and the farthest point of a box.
[[nodiscard]] double least_squared_distance(const Point& p, const Box& box);
[[nodiscard]] double greatest_squared_distance(const Point& p, const Box& box);

/// Extends a box by another.
void extend_by(Box& box, const Box& other);
/// Returns the coordinate in which a box is longest.
[[nodiscard]] double Point::*longest_axis(const Box& box);

/// Adds nothing to the boxes of a tree.
struct NoBound {
    template <class Item>
    explicit NoBound(std::span<const Item> /*items*/) {}
    [[nodiscard]] double least_squared_distance(const Point& /*p*/) const { return 0; }
};

/// A tree of the bounding boxes of items, which BoxOf()(item) returns. A Bound, made of a span of
/// items, is another lower bound of the distance to them.
template <class Item, class BoxOf, class Bound = NoBound>
class BoxTree {
public:
    explicit BoxTree(std::vector<Item> items) : items_(std::move(items)) {
        if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
    }

    [[nodiscard]] bool empty() const { return items_.empty(); }

    /// Returns up to `most` boxes, each with items, that contain all items.
    [[nodiscard]] std::vector<Box> boxes(std::size_t most) const {
        if (nodes_.empty()) return {};
        std::vector<std::uint32_t> front{0};
        for (bool is_divided = true; is_divided && 2 * front.size() <= most;) {
            is_divided = false;
            std::vector<std::uint32_t> next;
            for (const std::uint32_t node : front) {
                if (nodes_[node].right == 0) {
                    next.push_back(node);
                    continue;
                }
                next.push_back(node + 1);
                next.push_back(nodes_[node].right);
                is_divided = true;
            }
            front = std::move(next);
        }
        std::vector<Box> boxes;
        for (const std::uint32_t node : front) boxes.push_back(nodes_[node].box);
        return boxes;
    }

    /// Calls visit(item) for items in ascending order of the lower bounds of their distances,
    /// approximately, and for all whose bound, squared, is at most `limit`, which visit() may
    /// lower.
    void visit_near(const Point& p, const double& limit, auto&& visit) const {
        if (nodes_.empty()) return;
        struct Waiting {
            std::uint32_t node;
            double squared;
        };
        const auto waiting = [&](std::uint32_t number) {
            const auto& [box, bound, begin, end, right] = nodes_[number];
            return Waiting{number, std::max(octetra::least_squared_distance(p, box),
                                            bound.least_squared_distance(p))};
        };
        std::array<Waiting, 80> stack{};  // two for each level of the tree
        std::size_t size = 0;
        stack[size++] = waiting(0);
        while (size > 0) {
            const auto [number, squared] = stack[--size];
            if (squared > limit) continue;
            const Node& node = nodes_[number];
            if (node.right == 0) {
                for (std::uint32_t i = node.begin; i < node.end; ++i) visit(items_[i]);
                continue;
            }
            Waiting near = waiting(number + 1);
            Waiting far = waiting(node.right);
            if (far.squared < near.squared) std::swap(near, far);
            stack[size++] = far;
            stack[size++] = near;
        }
    }

private:
    static constexpr std::uint32_t leaf_size = 4;

    struct Node {
        Box box;
        Bound bound;
        std::uint32_t begin = 0;  ///< of its items
        std::uint32_t end = 0;
        std::uint32_t right =
            0;  ///< the second child, 0 for a leaf; the first one follows the node
    };

    // The depth is the logarithm of the number of items, as halves are equally large.
    void build(std::uint32_t begin, std::uint32_t end) {
        const std::size_t node = nodes_.size();
        const std::span<const Item> items(items_.data() + begin, end - begin);
        nodes_.push_back({BoxOf()(items_[begin]), Bound(items), begin, end, 0});
        for (std::uint32_t i = begin + 1; i < end; ++i) {
            extend_by(nodes_[node].box, BoxOf()(items_[i]));
        }
        if (end - begin <= leaf_size) return;
        double Point::*const axis = longest_axis(nodes_[node].box);
        const std::uint32_t middle = begin + (end - begin) / 2;
        const auto centre = [axis](const Item& item) {
            const Box box = BoxOf()(item);
            return box.low.*axis / 2 + box.high.*axis / 2;
        };
        std::ranges::nth_element(items_.begin() + begin, items_.begin() + middle,
                                 items_.begin() + end, {}, centre);
        build(begin, middle);
        nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
        build(middle, end);
    }

    std::vector<Item> items_;
    std::vector<Node> nodes_;
};

}  // namespace octetra
