#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>

#include "partition/key_search.hpp"
#include "partition/rcb.hpp"

namespace octetra::distributed {

/// A set of points that becomes the parts begin .. end-1.
struct BisectionBox {
    int begin = 0;
    int end = 0;

    [[nodiscard]] bool is_part() const { return end - begin == 1; }
    [[nodiscard]] int middle() const { return begin + (end - begin) / 2; }
};

/// The limits of all boxes: a point belongs to the first half of its box if its coordinate is below
/// the limit, or equal to it and its number is below that of the limit.
struct BoxLimits {
    std::vector<Key> coordinate;
    std::vector<Key> number;

    [[nodiscard]] bool is_below(std::size_t box, Key of_coordinate, Key of_number) const {
        return of_coordinate < coordinate[box] ||
               (of_coordinate == coordinate[box] && of_number < number[box]);
    }
};

/// Finds the limits of all boxes of a level of the tree together, digit by digit, first of the
/// coordinates, then of the numbers of points with equal coordinates. Each digit takes one
/// reduction; after every two of them another one determines the range of the remaining points'
/// keys. As soon as few points remain that may be at a limit, all processes receive these, and find
/// the limits locally.
class LimitSearch {
public:
    LimitSearch(const Communicator& processes, const WeighedPoints& points, int parts);

    /// The box of each point, and its coordinate along the box's axis.
    struct PointBoxes {
        std::span<const BisectionBox> boxes;
        std::span<const int> box_of;
        std::span<const Key> coordinate;
    };

    /// Collective. `searches` has the range of the coordinates of each box's points.
    void find(const PointBoxes& point_boxes, std::vector<Search>& searches);
    [[nodiscard]] const BoxLimits& limits() const { return limits_; }

private:
    struct RemainingPoint {
        std::size_t box = 0;
        Key coordinate = 0;
        Key number = 0;
        std::uint64_t weight = 0;

        friend auto operator<=>(const RemainingPoint&, const RemainingPoint&) = default;
    };
    enum class By { coordinate, number };

    [[nodiscard]] std::size_t box_of(std::size_t i) const {
        return static_cast<std::size_t>(point_boxes_.box_of[i]);
    }
    [[nodiscard]] std::uint64_t weight(std::size_t i) const {
        return points_->weight ? points_->weight(i) : 1;
    }
    [[nodiscard]] Key key(std::size_t i, By by) const {
        return by == By::coordinate ? point_boxes_.coordinate[i] : points_->number(i);
    }
    [[nodiscard]] unsigned digit_bits() const;
    [[nodiscard]] unsigned remaining_rounds() const;
    void for_each_remaining(By by, auto&& visit) const;
    void filter_remaining(By by, std::size_t count);
    [[nodiscard]] bool find_by(By by, unsigned rounds);
    [[nodiscard]] std::uint64_t find_digit(By by);
    void find_extents(By remaining, By kind);
    void find_among_gathered(By by);
    void set_limits_from_gathered();

    const Communicator* processes_;
    const WeighedPoints* points_;
    std::vector<RemainingPoint> gathered_;  // of all processes
    PointBoxes point_boxes_;
    std::vector<Search>* searches_ = nullptr;
    std::vector<std::uint64_t> target_;   // of each box, the remaining weight before the limit
    std::vector<std::size_t> remaining_;  // points that may be at the limit, once they are few
    bool is_filtered_ = false;
    BoxLimits limits_;
};

}  // namespace octetra::distributed
