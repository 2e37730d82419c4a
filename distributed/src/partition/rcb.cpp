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
    Bisection(const Communicator& processes, const std::vector<WeighedPoint>& points, int parts)
        : processes_(&processes), points_(&points), box_of_(points.size(), 0), boxes_{{0, parts}} {}

    /// Collective. Cuts every box that is to be more than one part; false if there is none, or a
    /// process has failed.
    bool cut_boxes(LocalFailure& failure) {
        if (std::ranges::all_of(boxes_, &Box::is_part)) return false;
        find_axes(failure);
        if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return false;
        find_targets(failure);
        // First the coordinate, then among equal ones the number.
        find_limits(
            failure, [&](std::size_t i) { return coordinate(i); }, coordinate_limit_,
            [](std::size_t) { return true; });
        find_limits(
            failure, [&](std::size_t i) { return (*points_)[i].number; }, number_limit_,
            [&](std::size_t i) { return coordinate(i) == coordinate_limit_[box_of_[i]]; });
        failure.attempt([&] { divide(); });
        return failure.max_unless_failed(*processes_, 0) != LocalFailure::somewhere;
    }

    [[nodiscard]] std::vector<int> parts() const {
        std::vector<int> parts;
        parts.reserve(box_of_.size());
        for (const std::uint32_t box : box_of_) parts.push_back(boxes_[box].begin);
        return parts;
    }

private:
    static constexpr std::size_t digits = 256;

    [[nodiscard]] Key coordinate(std::size_t i) const {
        return keys_of((*points_)[i].point)[axis_[box_of_[i]]];
    }

    /// Collective.
    void find_axes(LocalFailure& failure) {
        std::vector<Key> extremes;  // of each box and axis the greatest key and complement
        failure.attempt([&] {
            extremes.assign(6 * boxes_.size(), 0);
            for (std::size_t i = 0; i < points_->size(); ++i) {
                const auto keys = keys_of((*points_)[i].point);
                Key* const box = extremes.data() + std::size_t{6} * box_of_[i];
                for (std::size_t k = 0; k < 3; ++k) {
                    box[2 * k] = std::max(box[2 * k], keys[k]);
                    box[2 * k + 1] = std::max(box[2 * k + 1], ~keys[k]);
                }
            }
        });
        if (failure.max_unless_failed(*processes_, 0) == LocalFailure::somewhere) return;
        processes_->max(std::span(extremes));
        failure.attempt([&] {
            axis_.clear();
            for (std::size_t b = 0; b < boxes_.size(); ++b) {
                std::array<double, 3> extent{};
                for (std::size_t k = 0; k < 3; ++k) {
                    const Key* const pair = extremes.data() + 6 * b + 2 * k;
                    if (pair[0] == 0 && pair[1] == 0) continue;  // an empty box
                    extent[k] = coordinate_of(pair[0]) / 2 - coordinate_of(~pair[1]) / 2;
                }
                axis_.push_back(
                    static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin()));
            }
        });
    }

    /// Collective. How much weight is to go to the first half of each box.
    void find_targets(LocalFailure& failure) {
        std::vector<std::uint64_t> weights;
        failure.attempt([&] {
            weights.assign(boxes_.size(), 0);
            for (std::size_t i = 0; i < points_->size(); ++i) {
                weights[box_of_[i]] += (*points_)[i].weight;
            }
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

    /// Collective. Of each box the key below which points together have not more than the target,
    /// while with those of the key itself they have, digit by digit. `target_` becomes what is left
    /// for points of that very key.
    void find_limits(LocalFailure& failure, auto&& key, std::vector<Key>& limits, auto&& counts) {
        failure.attempt([&] { limits.assign(boxes_.size(), 0); });
        for (unsigned shift = 64; shift > 0;) {
            shift -= 8;
            std::vector<std::uint64_t> sums;
            failure.attempt([&] {
                sums.assign(digits * boxes_.size(), 0);
                for (std::size_t i = 0; i < points_->size(); ++i) {
                    if (!counts(i)) continue;
                    const Key k = key(i);
                    const bool same_before =
                        shift == 56 || k >> (shift + 8) == limits[box_of_[i]] >> (shift + 8);
                    if (same_before) {
                        sums[digits * box_of_[i] + (k >> shift & 255U)] += (*points_)[i].weight;
                    }
                }
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
        std::vector<std::uint32_t> first_half(boxes_.size());
        for (std::size_t b = 0; b < boxes_.size(); ++b) {
            first_half[b] = static_cast<std::uint32_t>(boxes.size());
            const Box& box = boxes_[b];
            if (box.is_part()) {
                boxes.push_back(box);
            } else {
                boxes.push_back({box.begin, box.middle()});
                boxes.push_back({box.middle(), box.end});
            }
        }
        for (std::size_t i = 0; i < points_->size(); ++i) {
            const std::uint32_t b = box_of_[i];
            const Key c = boxes_[b].is_part() ? 0 : coordinate(i);
            const bool is_first =
                boxes_[b].is_part() || c < coordinate_limit_[b] ||
                (c == coordinate_limit_[b] && (*points_)[i].number < number_limit_[b]);
            box_of_[i] = first_half[b] + (is_first ? 0U : 1U);
        }
        boxes_ = std::move(boxes);
    }

    const Communicator* processes_;
    const std::vector<WeighedPoint>* points_;
    std::vector<std::uint32_t> box_of_;
    std::vector<Box> boxes_;
    std::vector<std::size_t> axis_;
    std::vector<std::uint64_t> target_;
    std::vector<Key> coordinate_limit_;
    std::vector<Key> number_limit_;
};

}  // namespace

std::vector<int> bisect_coordinates(const Communicator& processes,
                                    const std::vector<WeighedPoint>& points, int parts,
                                    LocalFailure& failure) {
    std::vector<Bisection> bisection;
    failure.attempt([&] { bisection.emplace_back(processes, points, parts); });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return {};
    while (bisection.front().cut_boxes(failure)) {
    }
    std::vector<int> part_of;
    failure.attempt([&] { part_of = bisection.front().parts(); });
    return part_of;
}

}  // namespace octetra::distributed
