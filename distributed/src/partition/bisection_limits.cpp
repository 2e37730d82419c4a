#include "partition/bisection_limits.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace octetra::distributed {
namespace {

/// Numbers reduced at once, 64 kB, while the boxes are at most a quarter as many.
constexpr std::size_t most_sums = std::size_t{1} << 13U;
constexpr unsigned least_bits = 2;
/// Each point is represented by this many numbers.
constexpr std::size_t words_of_one = 4;
constexpr std::size_t few = most_sums / words_of_one;

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
      reduced_(std::max(2 * most_sums,
                        (std::size_t{1} << least_bits) * static_cast<std::size_t>(parts)) +
               1) {
    const auto boxes = static_cast<std::size_t>(parts);
    few_.reserve(few);
    target_.reserve(boxes);
    limits_.coordinate.reserve(boxes);
    limits_.number.reserve(boxes);
}

unsigned LimitSearch::digit_bits() const {
    return std::max(least_bits, 14U - static_cast<unsigned>(std::bit_width(searches_->size())));
}

/// Calls look_at(i, box) for those of this process's points that may be at the limit of their box.
void LimitSearch::for_each_left(By by, auto&& look_at) const {
    const auto look = [&](std::size_t i) {
        const std::size_t b = box_of(i);
        if (!places_.boxes[b].is_part() && (*searches_)[b].may_be(key(i, by))) look_at(i, b);
    };
    if (are_few_here_) {
        for (const std::size_t i : left_) look(i);
    } else {
        for (std::size_t i = 0; i < points_->count; ++i) look(i);
    }
}

void LimitSearch::keep_left(By by, std::size_t count) {
    std::vector<std::size_t> left;
    left.reserve(count);
    for_each_left(by, [&](std::size_t i, std::size_t) { left.push_back(i); });
    left_ = std::move(left);
    are_few_here_ = true;
}

bool LimitSearch::find(const Places& places, std::vector<Search>& searches, LocalFailure& failure) {
    places_ = places;
    searches_ = &searches;
    are_few_here_ = false;
    target_.clear();  // unknown until the weights are added up
    limits_.coordinate.clear();
    limits_.number.clear();
    // The first round adds up all weights.
    const Found by_coordinate = find_by(By::coordinate, std::max(1U, rounds_to_go()), failure);
    if (by_coordinate != Found::not_yet) return by_coordinate == Found::all;
    for (const Search& search : searches) limits_.coordinate.push_back(search.limit());
    if (!find_extents(By::coordinate, By::number, failure)) return false;
    const Found by_number = find_by(By::number, rounds_to_go(), failure);
    if (by_number != Found::not_yet) return by_number == Found::all;
    for (const Search& search : searches) limits_.number.push_back(search.limit());
    return true;
}

unsigned LimitSearch::rounds_to_go() const {
    const unsigned most = std::ranges::max(*searches_, {}, &Search::bits).bits;
    return (most + digit_bits() - 1) / digit_bits();
}

LimitSearch::Found LimitSearch::find_by(By by, unsigned rounds, LocalFailure& failure) {
    for (unsigned done = 1; rounds > 0; ++done) {
        const Found found = find_digit(by, failure);
        if (found == Found::nowhere) return found;
        if (found == Found::all) {
            return find_among_few(by, failure) ? Found::all : Found::nowhere;
        }
        // In a lattice, few different keys, or a single one, remain after few of their digits.
        if (--rounds > 2 && done % 2 == 0) {
            if (!find_extents(by, by, failure)) return Found::nowhere;
            rounds = rounds_to_go();
        }
    }
    return Found::not_yet;
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
        for_each_left(by, [&](std::size_t i, std::size_t b) {
            const std::size_t at = (b << digit) + (*searches_)[b].digit_of(key(i, by), digit);
            sums[at] += weight(i);
            ++own[at];
            ++count;
        });
    });
    const std::size_t looked_at = count;
    if (!reduced_.sum(*processes_, failure)) return Found::nowhere;
    const bool is_first = target_.empty();
    std::size_t found = 0;
    for (std::size_t b = 0; b < boxes; ++b) {
        const auto of_box = sums.subspan(b << digit, std::size_t{1} << digit);
        if (is_first) target_.push_back(share_of_first(places_.boxes[b], of_box));
        std::size_t d = 0;
        while (d + 1 < of_box.size() && of_box[d] <= target_[b]) target_[b] -= of_box[d++];
        found += own[(b << digit) + d];
        (*searches_)[b].take(places_.boxes[b].is_part() ? 0 : d, digit);
    }
    failure.attempt([&] {
        if (found <= looked_at / 4) keep_left(by, found);
    });
    return count <= few ? Found::all : Found::not_yet;
}

/// Collective. Starts to search for keys of the given kind, between the extremes of the remaining
/// points.
bool LimitSearch::find_extents(By left, By kind, LocalFailure& failure) {
    const auto keys =
        reduced_.zeros(2 * searches_->size());  // of each box: maximum, and maximum complement
    failure.attempt([&] {
        std::size_t count = 0;
        for_each_left(left, [&](std::size_t i, std::size_t b) {
            keys[2 * b] = std::max(keys[2 * b], key(i, kind));
            keys[2 * b + 1] = std::max(keys[2 * b + 1], ~key(i, kind));
            ++count;
        });
        keep_left(left, count);
    });
    if (!reduced_.max(*processes_, failure)) return false;
    for (std::size_t b = 0; b < searches_->size(); ++b) {
        const bool is_empty = keys[2 * b] == 0 && keys[2 * b + 1] == 0;
        if (is_empty && left == kind) continue;  // its limit is known
        (*searches_)[b] = between(~keys[2 * b + 1], keys[2 * b], is_empty);
    }
    return true;
}

/// Collective. Sends all remaining points to all processes, which find the limits among them.
bool LimitSearch::find_among_few(By by, LocalFailure& failure) {
    std::uint64_t count = 0;
    failure.attempt([&] { for_each_left(by, [&](std::size_t, std::size_t) { ++count; }); });
    std::uint64_t next = processes_->sum_before(count);
    const auto words = reduced_.zeros(words_of_one * few + 1);
    words.back() = count;
    failure.attempt([&] {
        for_each_left(by, [&](std::size_t i, std::size_t b) {
            const auto of_one = words.subspan(words_of_one * next++, words_of_one);
            of_one[0] = b;
            of_one[1] = places_.coordinate[i];
            of_one[2] = points_->number(i);
            of_one[3] = weight(i);
        });
    });
    if (!reduced_.sum(*processes_, failure)) return false;
    few_.clear();
    for (std::size_t k = 0; k < words.back(); ++k) {
        const auto of_one = words.subspan(words_of_one * k, words_of_one);
        few_.push_back({of_one[0], of_one[1], of_one[2], of_one[3]});
    }
    std::ranges::sort(few_);
    for (const Search& search : *searches_) {
        if (by == By::coordinate) limits_.coordinate.push_back(search.limit());
        limits_.number.push_back(by == By::number ? search.limit() : 0);
    }
    take_limits_among_few();
    return true;
}

/// The limit of each box is the first point that would exceed the share of its first half.
void LimitSearch::take_limits_among_few() {
    for (std::size_t k = 0; k < few_.size();) {
        const std::size_t b = few_[k].box;
        for (; k < few_.size() && few_[k].box == b && few_[k].weight <= target_[b]; ++k) {
            target_[b] -= few_[k].weight;
        }
        if (k < few_.size() && few_[k].box == b) {
            limits_.coordinate[b] = few_[k].coordinate;
            limits_.number[b] = few_[k].number;
        }
        while (k < few_.size() && few_[k].box == b) ++k;
    }
}

}  // namespace octetra::distributed
