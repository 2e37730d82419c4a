#include "partition/rcb.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <octetra/core/huge_pages.hpp>

#include "partition/bisection_limits.hpp"
#include "partition/key_search.hpp"

namespace octetra::distributed {
namespace {

double along(std::size_t axis, const Point& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

class Bisection {
public:
    Bisection(const Communicator& processes, const WeighedPoints& points, int parts)
        : processes_(&processes),
          points_(&points),
          limits_(processes, points, parts),
          boxes_{{0, parts}},
          axis_{0} {
        reserve_in_huge_pages(coordinate_, points.count);
        coordinate_.resize(points.count);
        reserve_in_huge_pages(box_of_, points.count);
        box_of_.resize(points.count, 0);
        searches_.reserve(static_cast<std::size_t>(parts));
        extents_.reserve(static_cast<std::size_t>(parts));
    }

    /// Collective. Returns the part of each point.
    [[nodiscard]] std::vector<int> parts() && {
        guess_axis();
        while (!std::ranges::all_of(boxes_, &BisectionBox::is_part)) {
            find_axes();
            limits_.find({boxes_, box_of_, coordinate_}, searches_);
            divide();
        }
        for (int& box : box_of_) box = boxes_[static_cast<std::size_t>(box)].begin;
        return std::move(box_of_);
    }

private:
    [[nodiscard]] std::size_t box_of(std::size_t i) const {
        return static_cast<std::size_t>(box_of_[i]);
    }

    /// Calls visit(i, point) for all points of this process, which are requested in blocks.
    void for_each_point(auto&& visit) const {
        std::array<Point, 512> some;
        for (std::size_t begin = 0; begin < points_->count; begin += some.size()) {
            const std::size_t count = std::min(some.size(), points_->count - begin);
            points_->points(begin, std::span(some).first(count));
            for (std::size_t k = 0; k < count; ++k) visit(begin + k, some[k]);
        }
    }

    struct Extremes {
        static constexpr double most = std::numeric_limits<double>::infinity();
        std::array<double, 3> low{most, most, most};
        std::array<double, 3> high{-most, -most, -most};

        void take(const Point& p) {
            const std::array<double, 3> position{p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], position[k]);
                high[k] = std::max(high[k], position[k]);
            }
        }
        /// Stores keys whose maxima over all processes belong to the extremes of all points: the
        /// key of each maximum, and the complement of the key of each minimum; zeros if there are
        /// no points.
        void put(std::span<Key, 6> keys) const {
            if (low[0] > high[0]) return;
            for (std::size_t k = 0; k < 3; ++k) {
                keys[2 * k] = key_of(high[k]);
                keys[2 * k + 1] = ~key_of(low[k]);
            }
        }
    };

    [[nodiscard]] static bool is_empty(std::span<const Key, 6> keys) {
        return std::ranges::all_of(keys, [](Key key) { return key == 0; });
    }
    /// Returns half of each extent, as the extent itself might overflow.
    [[nodiscard]] static std::array<double, 3> extent_between(std::span<const Key, 6> keys) {
        std::array<double, 3> extent{};
        for (std::size_t k = 0; k < 3 && !is_empty(keys); ++k) {
            extent[k] = coordinate_of(keys[2 * k]) / 2 - coordinate_of(~keys[2 * k + 1]) / 2;
        }
        return extent;
    }

    /// Returns the extremes of a sample of points.
    [[nodiscard]] Extremes extremes_of_sample() const {
        constexpr std::size_t wanted = 256;
        Extremes extremes;
        for (std::size_t k = 0; k < wanted && points_->count > 0; ++k) {
            Point one;
            points_->points(points_->count * k / wanted, std::span(&one, 1));
            extremes.take(one);
        }
        return extremes;
    }

    /// Collective. Guesses the longest axis from a few points of each process.
    void guess_axis() {
        std::array<Key, 6> keys{};
        extremes_of_sample().put(keys);
        processes_->max(std::span<Key>(keys));
        axis_[0] = longest(extent_between(keys));
    }

    /// Collective. Determines the longest axis of each box, and the coordinate of each point along
    /// it. The axis is guessed first, since a second pass over the points takes time.
    void find_axes() {
        std::vector<Key> keys(6 * boxes_.size());
        const auto of_box = [&](std::size_t b) {
            return std::span(keys).subspan(6 * b).first<6>();
        };
        std::vector<Extremes> extremes(boxes_.size());
        for_each_point([&](std::size_t i, const Point& p) {
            extremes[box_of(i)].take(p);
            coordinate_[i] = key_of(along(axis_[box_of(i)], p));
        });
        for (std::size_t b = 0; b < boxes_.size(); ++b) extremes[b].put(of_box(b));
        processes_->max(std::span(keys));
        extents_.clear();
        searches_.clear();
        bool is_as_guessed = true;
        for (std::size_t b = 0; b < boxes_.size(); ++b) {
            const std::size_t guess = axis_[b];
            extents_.push_back(extent_between(of_box(b)));
            axis_[b] = longest(extents_.back());
            is_as_guessed = is_as_guessed && axis_[b] == guess;
            const auto along_axis = of_box(b).subspan(2 * axis_[b], 2);
            searches_.push_back(between(~along_axis[1], along_axis[0], is_empty(of_box(b))));
        }
        if (is_as_guessed) return;
        for_each_point([&](std::size_t i, const Point& p) {
            coordinate_[i] = key_of(along(axis_[box_of(i)], p));
        });
    }

    void divide() {
        std::vector<BisectionBox> boxes;
        std::vector<std::size_t> guess;
        std::vector<int> first_half(boxes_.size());
        const BoxLimits& limits = limits_.limits();
        for (std::size_t b = 0; b < boxes_.size(); ++b) {
            first_half[b] = static_cast<int>(boxes.size());
            const BisectionBox& box = boxes_[b];
            if (box.is_part()) {
                boxes.push_back(box);
                guess.push_back(axis_[b]);
            } else {
                auto extent = extents_[b];
                extent[axis_[b]] /= 2;
                guess.insert(guess.end(), 2, longest(extent));
                boxes.push_back({box.begin, box.middle()});
                boxes.push_back({box.middle(), box.end});
            }
        }
        for (std::size_t i = 0; i < points_->count; ++i) {
            const std::size_t b = box_of(i);
            const bool is_first =
                boxes_[b].is_part() || limits.is_below(b, coordinate_[i], points_->number(i));
            box_of_[i] = first_half[b] + (is_first ? 0 : 1);
        }
        boxes_ = std::move(boxes);
        axis_ = std::move(guess);
    }

    /// Returns the last among the axes whose extent is within 1/64 of the longest. The cells of
    /// lattices are usually listed in layers along the last axis, so fewer cells then leave the
    /// process that has read them.
    static std::size_t longest(const std::array<double, 3>& extent) {
        const double nearly = std::ranges::max(extent) * (1 - 1.0 / 64);
        std::size_t axis = 2;
        while (axis > 0 && extent[axis] < nearly) --axis;
        return axis;
    }

    const Communicator* processes_;
    const WeighedPoints* points_;
    LimitSearch limits_;
    std::vector<Key> coordinate_;  // along the axis of the point's box
    std::vector<int> box_of_;
    std::vector<BisectionBox> boxes_;
    std::vector<std::size_t> axis_;
    std::vector<std::array<double, 3>> extents_;
    std::vector<Search> searches_;
};

}  // namespace

std::vector<int> bisect_coordinates(const Communicator& processes, const WeighedPoints& points,
                                    int parts) {
    return Bisection(processes, points, parts).parts();
}

std::vector<int> bisect_coordinates(const Communicator& processes,
                                    const std::vector<WeighedPoint>& points, int parts) {
    const auto positions = [&](std::size_t first, std::span<Point> some) {
        for (Point& position : some) position = points[first++].point;
    };
    return bisect_coordinates(processes,
                              {.count = points.size(),
                               .points = positions,
                               .number = [&](std::size_t i) { return points[i].number; },
                               .weight = [&](std::size_t i) { return points[i].weight; }},
                              parts);
}

}  // namespace octetra::distributed
