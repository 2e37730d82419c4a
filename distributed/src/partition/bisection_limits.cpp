#include "partition/bisection_limits.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace octetra::distributed {
namespace {

/// Numbers reduced at once, 64 kB, while the boxes are at most a quarter as many.
constexpr std::size_t max_sums = std::size_t{1} << 13U;
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
    : processes_(&processes),
      points_(&points),
      reduced_(
          std::max(2 * max_sums, (std::size_t{1} << least_bits) * static_cast<std::size_t>(parts)) +
          1) {
    const auto boxes = static_cast<std::size_t>(parts);
    gathered_.reserve(few);
    target_.reserve(boxes);
    limits_.coordinate.reserve(boxes);
    limits_.number.reserve(boxes);
}

unsigned LimitSearch::digit_bits() const {
    return std::max(least_bits, 14U - static_cast<unsigned>(std::bit_width(searches_->size())));
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

bool LimitSearch::find(const PointBoxes& point_boxes, std::vector<Search>& searches,
                       LocalFailure& failure) {
    point_boxes_ = point_boxes;
    searches_ = &searches;
    is_filtered_ = false;
    target_.clear();  // unknown until the weights are added up
    limits_.coordinate.clear();
    limits_.number.clear();
    // The first round adds up all weights.
    const Found by_coordinate = find_by(By::coordinate, std::max(1U, remaining_rounds()), failure);
    if (by_coordinate != Found::incomplete) return by_coordinate == Found::all;
    for (const Search& search : searches) limits_.coordinate.push_back(search.limit());
    if (!find_extents(By::coordinate, By::number, failure)) return false;
    const Found by_number = find_by(By::number, remaining_rounds(), failure);
    if (by_number != Found::incomplete) return by_number == Found::all;
    for (const Search& search : searches) limits_.number.push_back(search.limit());
    return true;
}

unsigned LimitSearch::remaining_rounds() const {
    const unsigned most = std::ranges::max(*searches_, {}, &Search::bits).bits;
    return (most + digit_bits() - 1) / digit_bits();
}

LimitSearch::Found LimitSearch::find_by(By by, unsigned rounds, LocalFailure& failure) {
    for (unsigned done = 1; rounds > 0; ++done) {
        const Found found = find_digit(by, failure);
        if (found == Found::failed) return found;
        if (found == Found::all) {
            return find_among_gathered(by, failure) ? Found::all : Found::failed;
        }
        // In a lattice, few different keys, or a single one, remain after few of their digits.
        if (--rounds > 2 && done % 2 == 0) {
            if (!find_extents(by, by, failure)) return Found::failed;
            rounds = remaining_rounds();
        }
    }
    return Found::incomplete;
}

/// Determines one more digit of the limit of each box. Returns `all` once so few points remain that
/// each process can examine all of them.
LimitSearch::Found LimitSearch::find_digit(By by, LocalFailure& failure) {
    const unsigned digit = digit_bits();
    const std::size_t boxes = searches_->size();
    const auto sums = reduced_.zeros((boxes << digit) + 1);
    std::uint64_t& count = sums.back();
    std::vector<std::uint32_t> own;  // number of this process's points in each sum
    failure.attempt([&] {
        own.resize(sums.size());
        for_each_remaining(by, [&](std::size_t i, std::size_t b) {
            const std::size_t at = (b << digit) + (*searches_)[b].digit_of(key(i, by), digit);
            sums[at] += weight(i);
            ++own[at];
            ++count;
        });
    });
    const std::size_t visited_count = count;
    if (!reduced_.sum(*processes_, failure)) return Found::failed;
    const bool is_first = target_.empty();
    std::size_t found = 0;
    for (std::size_t b = 0; b < boxes; ++b) {
        const auto of_box = sums.subspan(b << digit, std::size_t{1} << digit);
        if (is_first) target_.push_back(share_of_first(point_boxes_.boxes[b], of_box));
        std::size_t d = 0;
        while (d + 1 < of_box.size() && of_box[d] <= target_[b]) target_[b] -= of_box[d++];
        found += own[(b << digit) + d];
        (*searches_)[b].take(point_boxes_.boxes[b].is_part() ? 0 : d, digit);
    }
    failure.attempt([&] {
        if (found <= visited_count / 4) filter_remaining(by, found);
    });
    return count <= few ? Found::all : Found::incomplete;
}

/// Collective. Starts to search for keys of the given kind, between the extremes of the remaining
/// points.
bool LimitSearch::find_extents(By remaining, By kind, LocalFailure& failure) {
    const auto keys =
        reduced_.zeros(2 * searches_->size());  // of each box: maximum, and maximum complement
    failure.attempt([&] {
        std::size_t count = 0;
        for_each_remaining(remaining, [&](std::size_t i, std::size_t b) {
            keys[2 * b] = std::max(keys[2 * b], key(i, kind));
            keys[2 * b + 1] = std::max(keys[2 * b + 1], ~key(i, kind));
            ++count;
        });
        filter_remaining(remaining, count);
    });
    if (!reduced_.max(*processes_, failure)) return false;
    for (std::size_t b = 0; b < searches_->size(); ++b) {
        const bool is_empty = keys[2 * b] == 0 && keys[2 * b + 1] == 0;
        if (is_empty && remaining == kind) continue;  // its limit is known
        (*searches_)[b] = between(~keys[2 * b + 1], keys[2 * b], is_empty);
    }
    return true;
}

/// Collective. Sends all remaining points to all processes, which find the limits among them.
bool LimitSearch::find_among_gathered(By by, LocalFailure& failure) {
    std::uint64_t count = 0;
    failure.attempt([&] { for_each_remaining(by, [&](std::size_t, std::size_t) { ++count; }); });
    std::uint64_t next = processes_->sum_before(count);
    const auto words = reduced_.zeros(words_per_point * few + 1);
    words.back() = count;
    failure.attempt([&] {
        for_each_remaining(by, [&](std::size_t i, std::size_t b) {
            const auto point_words = words.subspan(words_per_point * next++, words_per_point);
            point_words[0] = b;
            point_words[1] = point_boxes_.coordinate[i];
            point_words[2] = points_->number(i);
            point_words[3] = weight(i);
        });
    });
    if (!reduced_.sum(*processes_, failure)) return false;
    gathered_.clear();
    for (std::size_t k = 0; k < words.back(); ++k) {
        const auto point_words = words.subspan(words_per_point * k, words_per_point);
        gathered_.push_back({point_words[0], point_words[1], point_words[2], point_words[3]});
    }
    std::ranges::sort(gathered_);
    for (const Search& search : *searches_) {
        if (by == By::coordinate) limits_.coordinate.push_back(search.limit());
        limits_.number.push_back(by == By::number ? search.limit() : 0);
    }
    set_limits_from_gathered();
    return true;
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
