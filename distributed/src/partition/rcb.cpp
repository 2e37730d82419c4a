#include "partition/rcb.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <span>

#include "partition/key_search.hpp"

namespace octetra::distributed {
namespace {

double along(std::size_t axis, const Point& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Some points, to become parts begin .. end-1.
struct Box {
    int begin = 0;
    int end = 0;

    [[nodiscard]] bool is_part() const { return end - begin == 1; }
    [[nodiscard]] int middle() const { return begin + (end - begin) / 2; }
};

class Bisection {
public:
    Bisection(const Communicator& processes, const WeighedPoints& points, int parts)
        : processes_(&processes),
          points_(&points),
          coordinate_(points.count),
          box_of_(points.count, 0),
          boxes_{{0, parts}},
          axis_{longest(extent_of_some())} {}

    /// Collective. Cuts every box that is to be more than one part; false if there is none, or a
    /// process has failed.
    bool cut_boxes(LocalFailure& failure) {
        if (std::ranges::all_of(boxes_, &Box::is_part)) return false;
        // First the coordinate, then among equal ones the number.
        if (!find_axes(failure) || !find_coordinates(failure) || !find_numbers(failure)) {
            return false;
        }
        failure.attempt([&] { divide(); });
        return nowhere(failure);
    }

    [[nodiscard]] std::vector<int> parts() && {
        for (int& box : box_of_) box = boxes_[static_cast<std::size_t>(box)].begin;
        return std::move(box_of_);
    }

private:
    [[nodiscard]] std::size_t box_of(std::size_t i) const {
        return static_cast<std::size_t>(box_of_[i]);
    }
    [[nodiscard]] std::uint64_t weight(std::size_t i) const {
        return points_->weights.empty() ? 1 : points_->weights[i];
    }
    /// Of the digits of one round: 2^13 for all boxes together, but 2^8 for each at least.
    [[nodiscard]] unsigned digit_bits() const {
        return std::max(8U, 14U - static_cast<unsigned>(std::bit_width(boxes_.size())));
    }

    /// Collective. Has no process failed?
    [[nodiscard]] bool nowhere(const LocalFailure& failure) const {
        return failure.max_unless_failed(*processes_, 0) != LocalFailure::somewhere;
    }

    /// Calls look_at(i, point) for all of this process's points, which are asked for some at once.
    void for_each_point(auto&& look_at) const {
        std::array<Point, 512> some;
        for (std::size_t begin = 0; begin < points_->count; begin += some.size()) {
            const std::size_t count = std::min(some.size(), points_->count - begin);
            points_->points(begin, std::span(some).first(count));
            for (std::size_t k = 0; k < count; ++k) look_at(begin + k, some[k]);
        }
    }

    /// Of a few points here and there.
    [[nodiscard]] std::array<double, 3> extent_of_some() const {
        constexpr std::size_t wanted = 256;
        Extremes extremes;
        for (std::size_t k = 0; k < wanted && points_->count > 0; ++k) {
            Point one;
            points_->points(points_->count * k / wanted, std::span(&one, 1));
            extremes.take(one);
        }
        return extremes.extent();
    }

    struct Extremes {
        static constexpr double most = std::numeric_limits<double>::infinity();
        std::array<double, 3> low{most, most, most};
        std::array<double, 3> high{-most, -most, -most};

        void take(const Point& p) {
            const std::array<double, 3> place{p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], place[k]);
                high[k] = std::max(high[k], place[k]);
            }
        }
        [[nodiscard]] bool empty() const { return low[0] > high[0]; }
        [[nodiscard]] std::array<double, 3> extent() const {
            std::array<double, 3> extent{};
            for (std::size_t k = 0; k < 3 && !empty(); ++k) extent[k] = high[k] / 2 - low[k] / 2;
            return extent;
        }
    };

    // Collective, the following. False, on all processes alike, where one has failed.

    /// The longest extent of each box; and of each point its coordinate there. Which it will be is
    /// guessed, as it takes time to have the points once more.
    bool find_axes(LocalFailure& failure) {
        std::vector<Key> keys;  // of each box and axis the greatest one and complement
        failure.attempt([&] {
            std::vector<Extremes> extremes(boxes_.size());
            for_each_point([&](std::size_t i, const Point& p) {
                extremes[box_of(i)].take(p);
                coordinate_[i] = key_of(along(axis_[box_of(i)], p));
            });
            keys.assign(6 * boxes_.size(), 0);
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                if (extremes[b].empty()) continue;
                for (std::size_t k = 0; k < 3; ++k) {
                    keys[6 * b + 2 * k] = key_of(extremes[b].high[k]);
                    keys[6 * b + 2 * k + 1] = ~key_of(extremes[b].low[k]);
                }
            }
        });
        if (!nowhere(failure)) return false;
        processes_->max(std::span(keys));
        failure.attempt([&] {
            const std::vector<std::size_t> guess = axis_;
            extents_.clear();
            searches_.clear();
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                const Key* const of_box = keys.data() + 6 * b;
                std::array<double, 3> extent{};
                const bool is_empty = std::all_of(of_box, of_box + 6, [](Key k) { return k == 0; });
                for (std::size_t k = 0; k < 3 && !is_empty; ++k) {
                    extent[k] =
                        coordinate_of(of_box[2 * k]) / 2 - coordinate_of(~of_box[2 * k + 1]) / 2;
                }
                axis_[b] = longest(extent);
                extents_.push_back(extent);
                searches_.push_back(
                    between(~of_box[2 * axis_[b] + 1], of_box[2 * axis_[b]], is_empty));
            }
            if (axis_ == guess) return;
            for_each_point([&](std::size_t i, const Point& p) {
                coordinate_[i] = key_of(along(axis_[box_of(i)], p));
            });
        });
        return nowhere(failure);
    }

    static Search between(Key low, Key high, bool is_empty) {
        if (is_empty) return {};
        return {.low = low, .bits = static_cast<unsigned>(std::bit_width(high - low))};
    }

    /// Of each box that is to be cut the coordinate below which points together have
    /// not more than the first half is to have, while with those of the coordinate itself they
    /// have. `target_` becomes what is left for points of that very coordinate.
    bool find_coordinates(LocalFailure& failure) {
        target_.clear();  // not known before all weights are added up
        is_left_ = false;
        // All weights are added up in the first round.
        for (unsigned rounds = std::max(1U, rounds_to_go()); rounds > 0; --rounds) {
            if (!find_digits(
                    failure, points_->count, [](std::size_t i) { return i; },
                    [&](std::size_t i) { return coordinate_[i]; })) {
                return false;
            }
        }
        failure.attempt([&] { take_limits(coordinate_limit_); });
        return true;
    }

    /// The same with the numbers of those that only these tell from others at the
    /// limit.
    bool find_numbers(LocalFailure& failure) {
        std::vector<Key> keys;  // of each box the greatest one and complement
        failure.attempt([&] {
            equal_.clear();
            keys.assign(2 * boxes_.size(), 0);
            for (std::size_t i = 0; i < points_->count; ++i) {
                const std::size_t b = box_of(i);
                if (coordinate_[i] != coordinate_limit_[b] || boxes_[b].is_part()) continue;
                equal_.push_back(i);
                keys[2 * b] = std::max(keys[2 * b], points_->number(i));
                keys[2 * b + 1] = std::max(keys[2 * b + 1], ~points_->number(i));
            }
        });
        if (!nowhere(failure)) return false;
        processes_->max(std::span(keys));
        failure.attempt([&] {
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                searches_[b] = between(~keys[2 * b + 1], keys[2 * b], keys[2 * b + 1] == 0);
            }
            is_left_ = false;
        });
        if (!nowhere(failure)) return false;
        for (unsigned rounds = rounds_to_go(); rounds > 0; --rounds) {
            if (!find_digits(
                    failure, equal_.size(), [&](std::size_t k) { return equal_[k]; },
                    points_->number)) {
                return false;
            }
        }
        failure.attempt([&] { take_limits(number_limit_); });
        return true;
    }

    /// Until all keys are known.
    [[nodiscard]] unsigned rounds_to_go() const {
        const unsigned most = std::ranges::max(searches_, {}, &Search::bits).bits;
        return (most + digit_bits() - 1) / digit_bits();
    }

    void take_limits(std::vector<Key>& limits) {
        limits.clear();
        for (const Search& search : searches_) limits.push_back(search.limit());
    }

    /// One digit more of what is looked for in each box. Looks at those of `count` points, place(0)
    /// .. place(count-1), that may have that key.
    bool find_digits(LocalFailure& failure, std::size_t count, auto&& place, auto&& key) {
        const unsigned digit = digit_bits();
        const auto for_each_left = [&](auto&& look_at) {
            const auto look = [&](std::size_t i) {
                const std::size_t b = box_of(i);
                if (searches_[b].may_be(key(i)) && !boxes_[b].is_part()) look_at(i, b);
            };
            if (is_left_) {
                for (const std::size_t i : left_) look(i);
            } else {
                for (std::size_t j = 0; j < count; ++j) look(place(j));
            }
        };
        std::vector<std::uint64_t> sums;
        std::vector<std::uint64_t> own;  // where each point weighs 1, they count them
        std::size_t found = 0;
        failure.attempt([&] {
            sums.assign(boxes_.size() << digit, 0);
            for_each_left([&](std::size_t i, std::size_t b) {
                sums[(b << digit) + searches_[b].digit_of(key(i), digit)] += weight(i);
            });
            if (points_->weights.empty()) own = sums;
        });
        if (!nowhere(failure)) return false;
        processes_->sum(std::span(sums));
        failure.attempt([&] {
            const bool is_first = target_.empty();
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                const auto of_box = std::span(sums).subspan(b << digit, std::size_t{1} << digit);
                if (is_first) target_.push_back(share_of_first(boxes_[b], of_box));
                std::size_t d = 0;
                while (d + 1 < of_box.size() && of_box[d] <= target_[b]) target_[b] -= of_box[d++];
                if (!own.empty()) found += own[(b << digit) + d];
                searches_[b].take(boxes_[b].is_part() ? 0 : d, digit);
            }
            if (own.empty()) for_each_left([&](std::size_t, std::size_t) { ++found; });
            if (found > (is_left_ ? left_.size() : count) / 4) return;
            std::vector<std::size_t> rest;
            rest.reserve(found);
            for_each_left([&](std::size_t i, std::size_t) { rest.push_back(i); });
            left_ = std::move(rest);
            is_left_ = true;
        });
        return true;
    }

    /// How much of the weight of a box is to go to its first half.
    static std::uint64_t share_of_first(const Box& box, std::span<const std::uint64_t> weights) {
        const std::uint64_t weight = std::accumulate(weights.begin(), weights.end(), Key{0});
        const auto all = static_cast<std::uint64_t>(box.end - box.begin);
        const auto first = static_cast<std::uint64_t>(box.middle() - box.begin);
        return weight / all * first + weight % all * first / all;
    }

    void divide() {
        std::vector<Box> boxes;
        std::vector<std::size_t> guess;
        std::vector<int> first_half(boxes_.size());
        for (std::size_t b = 0; b < boxes_.size(); ++b) {
            first_half[b] = static_cast<int>(boxes.size());
            const Box& box = boxes_[b];
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
                boxes_[b].is_part() || coordinate_[i] < coordinate_limit_[b] ||
                (coordinate_[i] == coordinate_limit_[b] && points_->number(i) < number_limit_[b]);
            box_of_[i] = first_half[b] + (is_first ? 0 : 1);
        }
        boxes_ = std::move(boxes);
        axis_ = std::move(guess);
    }

    static std::size_t longest(const std::array<double, 3>& extent) {
        return static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
    }

    const Communicator* processes_;
    const WeighedPoints* points_;
    std::vector<Key> coordinate_;  // along the axis of the point's box
    std::vector<int> box_of_;
    std::vector<Box> boxes_;
    std::vector<std::size_t> axis_;
    std::vector<std::array<double, 3>> extents_;
    std::vector<Search> searches_;
    std::vector<std::uint64_t> target_;
    std::vector<Key> coordinate_limit_;
    std::vector<Key> number_limit_;
    std::vector<std::size_t> equal_;
    std::vector<std::size_t> left_;  // those that may be at the limit, once they are few
    bool is_left_ = false;
};

}  // namespace

std::vector<std::uint64_t> whole_weights(std::span<const float> weights, float least) {
    constexpr double most = 0x1p+30;  // the sum of 2^32 of them is to fit
    std::vector<std::uint64_t> whole(weights.size());
    std::ranges::transform(weights, whole.begin(), [&](float weight) {
        return static_cast<std::uint64_t>(
            std::min(most, 1000.0 * static_cast<double>(weight) / static_cast<double>(least)));
    });
    return whole;
}

std::vector<int> bisect_coordinates(const Communicator& processes, const WeighedPoints& points,
                                    int parts, LocalFailure& failure) {
    std::vector<Bisection> bisection;
    failure.attempt([&] { bisection.emplace_back(processes, points, parts); });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return {};
    while (bisection.front().cut_boxes(failure)) {
    }
    std::vector<int> part_of;
    failure.attempt([&] { part_of = std::move(bisection.front()).parts(); });
    return part_of;
}

std::vector<int> bisect_coordinates(const Communicator& processes,
                                    const std::vector<WeighedPoint>& points, int parts,
                                    LocalFailure& failure) {
    WeighedPoints by_place;
    std::vector<std::uint64_t> weights;
    failure.attempt([&] {
        by_place.count = points.size();
        by_place.points = [&](std::size_t first, std::span<Point> places) {
            for (Point& place : places) place = points[first++].point;
        };
        by_place.number = [&](std::size_t i) { return points[i].number; };
        for (const WeighedPoint& point : points) weights.push_back(point.weight);
        by_place.weights = weights;
    });
    return bisect_coordinates(processes, by_place, parts, failure);
}

}  // namespace octetra::distributed
