#include "partition/bisection_limits.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace octetra::distributed {
namespace {

/// Numbers reduced at once, 64 kB, while the boxes are at most a quarter as many.
constexpr unsigned max_sums_bits = 13;
constexpr std::size_t max_sums = std::size_t{1} << max_sums_bits;
constexpr unsigned least_bits = 2;
/// Each point is represented by this many numbers.
constexpr std::size_t words_per_point = 4;
constexpr std::size_t few = max_sums / words_per_point;

/// Returns the share of a box's weight that its first half is to have.
std::uint64_t share_of_first(const BisectionBox& box, std::span<const std::uint64_t> weights) {
    const std::uint64_t weight = std::accumulate(weights.begin(), weights.end(), Key{0});
    const auto all = static_cast<std::uint64_t>(box.end - box.begin);
    const auto first = static_cast<std::uint64_t>(box.middle() - box.begin);
    return weight / all * first + weight % all * first / all;
}

}  // namespace

LimitSearch::LimitSearch(const Communicator& processes, const WeighedPoints& points, int parts)
    : processes_(&processes), points_(&points) {
    const auto boxes = static_cast<std::size_t>(parts);
    gathered_.reserve(few);
    target_.reserve(boxes);
    limits_.coordinate.reserve(boxes);
    limits_.number.reserve(boxes);
}

unsigned LimitSearch::digit_bits() const {
    const auto box_bits = static_cast<unsigned>(std::bit_width(searches_->size()));
    return max_sums_bits + 1 < box_bits + least_bits ? least_bits : max_sums_bits + 1 - box_bits;
}

/// Calls visit(i, box) for those of this process's points that may be at the limit of their box.
void LimitSearch::for_each_remaining(By by, auto&& visit) const {
    const auto visit_remaining = [&](std::size_t i) {
        const std::size_t b = box_of(i);
        if (!point_boxes_.boxes[b].is_part() && (*searches_)[b].may_be(key(i, by))) visit(i, b);
    };
    if (is_filtered_) {
        for (const std::size_t i : remaining_) visit_remaining(i);
    } else {
        for (std::size_t i = 0; i < points_->count; ++i) visit_remaining(i);
    }
}

void LimitSearch::filter_remaining(By by, std::size_t count) {
    std::vector<std::size_t> remaining;
    remaining.reserve(count);
    for_each_remaining(by, [&](std::size_t i, std::size_t) { remaining.push_back(i); });
    remaining_ = std::move(remaining);
    is_filtered_ = true;
}

void LimitSearch::find(const PointBoxes& point_boxes, std::vector<Search>& searches) {
    point_boxes_ = point_boxes;
    searches_ = &searches;
    is_filtered_ = false;
    target_.clear();  // unknown until the weights are added up
    limits_.coordinate.clear();
    limits_.number.clear();
    // The first round adds up all weights.
    if (find_by(By::coordinate, std::max(1U, remaining_rounds()))) return;
    for (const Search& search : searches) limits_.coordinate.push_back(search.limit());
    find_extents(By::coordinate, By::number);
    if (find_by(By::number, remaining_rounds())) return;
    for (const Search& search : searches) limits_.number.push_back(search.limit());
}

unsigned LimitSearch::remaining_rounds() const {
    const unsigned most = std::ranges::max(*searches_, {}, &Search::bits).bits;
    return (most + digit_bits() - 1) / digit_bits();
}

/// Collective. Returns whether few points remained, among which all limits were found.
bool LimitSearch::find_by(By by, unsigned rounds) {
    for (unsigned done = 1; rounds > 0; ++done) {
        if (find_digit(by) <= few) {
            find_among_gathered(by);
            return true;
        }
        // In a lattice, few different keys, or a single one, remain after few of their digits.
        if (--rounds > 2 && done % 2 == 0) {
            find_extents(by, by);
            rounds = remaining_rounds();
        }
    }
    return false;
}

/// Collective. Determines one more digit of the limit of each box. Returns the number of points of
/// all processes that remained before it.
std::uint64_t LimitSearch::find_digit(By by) {
    const unsigned digit = digit_bits();
    const std::size_t boxes = searches_->size();
    std::vector<std::uint64_t> sums((boxes << digit) + 1);
    std::uint64_t& count = sums.back();
    std::vector<std::uint32_t> own(sums.size());  // number of this process's points in each sum
    for_each_remaining(by, [&](std::size_t i, std::size_t b) {
        const std::size_t at = (b << digit) + (*searches_)[b].digit_of(key(i, by), digit);
        sums[at] += weight(i);
        ++own[at];
        ++count;
    });
    const std::size_t visited_count = count;
    processes_->sum(std::span(sums));
    const bool is_first = target_.empty();
    std::size_t found = 0;
    for (std::size_t b = 0; b < boxes; ++b) {
        const auto of_box = std::span(sums).subspan(b << digit, std::size_t{1} << digit);
        if (is_first) target_.push_back(share_of_first(point_boxes_.boxes[b], of_box));
        std::size_t d = 0;
        while (d + 1 < of_box.size() && of_box[d] <= target_[b]) target_[b] -= of_box[d++];
        found += own[(b << digit) + d];
        (*searches_)[b].take(point_boxes_.boxes[b].is_part() ? 0 : d, digit);
    }
    if (found <= visited_count / 4) filter_remaining(by, found);
    return count;
}

/// Collective. Starts to search for keys of the given kind, between the extremes of the remaining
/// points.
void LimitSearch::find_extents(By remaining, By kind) {
    // of each box: maximum, and maximum complement
    std::vector<std::uint64_t> keys(2 * searches_->size());
    std::size_t count = 0;
    for_each_remaining(remaining, [&](std::size_t i, std::size_t b) {
        keys[2 * b] = std::max(keys[2 * b], key(i, kind));
        keys[2 * b + 1] = std::max(keys[2 * b + 1], ~key(i, kind));
        ++count;
    });
    filter_remaining(remaining, count);
    processes_->max(std::span(keys));
    for (std::size_t b = 0; b < searches_->size(); ++b) {
        const bool is_empty = keys[2 * b] == 0 && keys[2 * b + 1] == 0;
        if (is_empty && remaining == kind) continue;  // its limit is known
        (*searches_)[b] = between(~keys[2 * b + 1], keys[2 * b], is_empty);
    }
}

/// Collective. Sends all remaining points to all processes, which find the limits among them.
void LimitSearch::find_among_gathered(By by) {
    std::uint64_t count = 0;
    for_each_remaining(by, [&](std::size_t, std::size_t) { ++count; });
    std::uint64_t next = processes_->sum_before(count);
    std::vector<std::uint64_t> words(words_per_point * few + 1);
    words.back() = count;
    for_each_remaining(by, [&](std::size_t i, std::size_t b) {
        const auto point_words =
            std::span(words).subspan(words_per_point * next++, words_per_point);
        point_words[0] = b;
        point_words[1] = point_boxes_.coordinate[i];
        point_words[2] = points_->number(i);
        point_words[3] = weight(i);
    });
    processes_->sum(std::span(words));
    gathered_.clear();
    for (std::size_t k = 0; k < words.back(); ++k) {
        const auto point_words = std::span(words).subspan(words_per_point * k, words_per_point);
        gathered_.push_back({point_words[0], point_words[1], point_words[2], point_words[3]});
    }
    std::ranges::sort(gathered_);
    for (const Search& search : *searches_) {
        if (by == By::coordinate) limits_.coordinate.push_back(search.limit());
        limits_.number.push_back(by == By::number ? search.limit() : 0);
    }
    set_limits_from_gathered();
}

/// The limit of each box is the first point that would exceed the share of its first half.
void LimitSearch::set_limits_from_gathered() {
    for (std::size_t k = 0; k < gathered_.size();) {
        const std::size_t b = gathered_[k].box;
        for (; k < gathered_.size() && gathered_[k].box == b && gathered_[k].weight <= target_[b];
             ++k) {
            target_[b] -= gathered_[k].weight;
        }
        if (k < gathered_.size() && gathered_[k].box == b) {
            limits_.coordinate[b] = gathered_[k].coordinate;
            limits_.number[b] = gathered_[k].number;
        }
        while (k < gathered_.size() && gathered_[k].box == b) ++k;
    }
}

}  // namespace octetra::distributed
