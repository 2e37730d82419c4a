#include "partition/rcb.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace octetra::distributed {
namespace {

using Key = std::uint64_t;

/// A whole number that orders as the coordinate does.
Key key_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
    return bits >> 63U != 0 ? ~bits : bits | std::uint64_t{1} << 63U;
}
double coordinate_of(Key key) {
    return std::bit_cast<double>(key >> 63U != 0 ? key & ~(std::uint64_t{1} << 63U) : ~key);
}

std::array<Key, 3> keys_of(const Point& p) { return {key_of(p.x), key_of(p.y), key_of(p.z)}; }

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
          boxes_{{0, parts}} {}

    /// Collective. Cuts every box that is to be more than one part; false if there is none, or a
    /// process has failed.
    bool cut_boxes(LocalFailure& failure) {
        if (std::ranges::all_of(boxes_, &Box::is_part)) return false;
        find_axes(failure);
        if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return false;
        find_targets(failure);
        // First the coordinate, then among equal ones the number.
        find_limits(
            failure, points_->count, [](std::size_t i) { return i; },
            [&](std::size_t i) { return coordinate_[i]; }, coordinate_limit_);
        failure.attempt([&] { find_equal(); });
        find_limits(
            failure, equal_.size(), [&](std::size_t k) { return equal_[k]; }, points_->number,
            number_limit_);
        failure.attempt([&] { divide(); });
        return failure.max_unless_failed(*processes_, 0) != LocalFailure::somewhere;
    }

    [[nodiscard]] std::vector<int> parts() && {
        for (int& box : box_of_) box = boxes_[static_cast<std::size_t>(box)].begin;
        return std::move(box_of_);
    }

private:
    static constexpr std::size_t digits = 256;

    [[nodiscard]] std::size_t box_of(std::size_t i) const {
        return static_cast<std::size_t>(box_of_[i]);
    }
    [[nodiscard]] std::uint64_t weight(std::size_t i) const {
        return points_->weights.empty() ? 1 : points_->weights[i];
    }

    /// Collective. The longest extent of each box; and of each point its coordinate there. Which it
    /// will be is guessed, as it takes time to have the points once more.
    void find_axes(LocalFailure& failure) {
        std::vector<Key> extremes;  // of each box and axis the greatest key and complement
        failure.attempt([&] {
            axis_.resize(boxes_.size(), 0);
            extremes.assign(6 * boxes_.size(), 0);
            for (std::size_t i = 0; i < points_->count; ++i) {
                const auto keys = keys_of(points_->point(i));
                Key* const box = extremes.data() + 6 * box_of(i);
                for (std::size_t k = 0; k < 3; ++k) {
                    box[2 * k] = std::max(box[2 * k], keys[k]);
                    box[2 * k + 1] = std::max(box[2 * k + 1], ~keys[k]);
                }
                coordinate_[i] = keys[axis_[box_of(i)]];
            }
        });
        if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return;
        processes_->max(std::span(extremes));
        failure.attempt([&] {
            const std::vector<std::size_t> guess = axis_;
            extents_.clear();
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                std::array<double, 3> extent{};
                for (std::size_t k = 0; k < 3; ++k) {
                    const Key* const pair = extremes.data() + 6 * b + 2 * k;
                    if (pair[0] == 0 && pair[1] == 0) continue;  // an empty box
                    extent[k] = coordinate_of(pair[0]) / 2 - coordinate_of(~pair[1]) / 2;
                }
                axis_[b] = longest(extent);
                extents_.push_back(extent);
            }
            if (axis_ == guess) return;
            for (std::size_t i = 0; i < points_->count; ++i) {
                coordinate_[i] = keys_of(points_->point(i))[axis_[box_of(i)]];
            }
        });
    }

    /// Collective. How much weight is to go to the first half of each box.
    void find_targets(LocalFailure& failure) {
        std::vector<std::uint64_t> weights;
        failure.attempt([&] {
            weights.assign(boxes_.size(), 0);
            for (std::size_t i = 0; i < points_->count; ++i) weights[box_of(i)] += weight(i);
        });
        if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return;
        processes_->sum(std::span(weights));
        failure.attempt([&] {
            target_.clear();
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                const auto all = static_cast<std::uint64_t>(boxes_[b].end - boxes_[b].begin);
                const auto first = static_cast<std::uint64_t>(boxes_[b].middle() - boxes_[b].begin);
                target_.push_back(weights[b] / all * first + weights[b] % all * first / all);
            }
        });
    }

    /// Points that only their numbers tell from others at the limit.
    void find_equal() {
        equal_.clear();
        for (std::size_t i = 0; i < points_->count; ++i) {
            if (coordinate_[i] == coordinate_limit_[box_of(i)]) equal_.push_back(i);
        }
    }

    /// Collective. Of each box the key below which points together have not more than the target,
    /// while with those of the key itself they have, digit by digit. `target_` becomes what is left
    /// for points of that very key. Looks at `count` points, place(0) .. place(count-1).
    void find_limits(LocalFailure& failure, std::size_t count, auto&& place, auto&& key,
                     std::vector<Key>& limits) {
        failure.attempt([&] { limits.assign(boxes_.size(), 0); });
        // Those whose digits up to now are the limit's, once they are few.
        std::vector<std::size_t> left;
        std::size_t left_count = count;
        for (unsigned shift = 64; shift > 0;) {
            shift -= 8;
            const auto has_digits = [&](std::size_t i) {
                return shift == 56 || key(i) >> (shift + 8) == limits[box_of(i)] >> (shift + 8);
            };
            const auto for_each_left = [&](auto&& look_at) {
                if (left_count == count) {
                    for (std::size_t j = 0; j < count; ++j) look_at(place(j));
                } else {
                    for (const std::size_t i : left) look_at(i);
                }
            };
            std::vector<std::uint64_t> sums;
            failure.attempt([&] {
                sums.assign(digits * boxes_.size(), 0);
                std::size_t found = 0;
                for_each_left([&](std::size_t i) {
                    if (!has_digits(i)) return;
                    ++found;
                    sums[digits * box_of(i) + (key(i) >> shift & 255U)] += weight(i);
                });
                if (found > left_count / 4) return;
                std::vector<std::size_t> rest;
                rest.reserve(found);
                for_each_left([&](std::size_t i) {
                    if (has_digits(i)) rest.push_back(i);
                });
                left = std::move(rest);
                left_count = found;
            });
            if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return;
            processes_->sum(std::span(sums));
            failure.attempt([&] {
                for (std::size_t b = 0; b < boxes_.size(); ++b) {
                    const std::uint64_t* const of_box = sums.data() + digits * b;
                    std::size_t digit = 0;
                    while (digit + 1 < digits && of_box[digit] <= target_[b]) {
                        target_[b] -= of_box[digit++];
                    }
                    limits[b] |= std::uint64_t{digit} << shift;
                }
            });
        }
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
    std::vector<std::uint64_t> target_;
    std::vector<Key> coordinate_limit_;
    std::vector<Key> number_limit_;
    std::vector<std::size_t> equal_;
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
        by_place.point = [&](std::size_t i) { return points[i].point; };
        by_place.number = [&](std::size_t i) { return points[i].number; };
        for (const WeighedPoint& point : points) weights.push_back(point.weight);
        by_place.weights = weights;
    });
    return bisect_coordinates(processes, by_place, parts, failure);
}

}  // namespace octetra::distributed
