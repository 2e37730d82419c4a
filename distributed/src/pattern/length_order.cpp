#include "pattern/length_order.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <octetra/core/edge_order.hpp>

#include "pattern/pairs.hpp"

namespace octetra::distributed {
namespace {

/// A value for each of a cell's six edges, in pairs: edges 0 and 1, 2 and 3, 4 and 5.
using SixValues = std::array<Pair, 3>;

/// The vector from the second end of each edge to the first, in one coordinate of the corners.
SixValues differences(double c0, double c1, double c2, double c3) {
    return {Pair{c0, c0} - Pair{c1, c2}, Pair{c0, c1} - Pair{c3, c2}, Pair{c1, c2} - Pair{c3, c3}};
}

/// The bit of the pair (i, j), i < j, in Comparisons.
constexpr std::int64_t bit_of(std::size_t i, std::size_t j) {
    return std::int64_t{1} << (i * (11 - i) / 2 + (j - i - 1));
}

/// Returns the result of compare(i, j) for each of the 15 pairs i < j, as Comparisons, combined
/// with `more`.
template <class Compare>
unsigned compare_all(const SixValues& values, Compare&& compare, PairMask more) {
    const auto [v01, v23, v45] = values;
    const Pair v12{v01[1], v23[0]};
    const Pair v34{v23[1], v45[0]};
    const Pair v40{v45[0], v01[0]};
    const Pair v55{v45[1], v45[1]};
    return bits_of(more | (compare(v01, v12) & PairMask{bit_of(0, 1), bit_of(1, 2)}) |
                   (compare(v23, v34) & PairMask{bit_of(2, 3), bit_of(3, 4)}) |
                   (compare(v40, v55) & PairMask{bit_of(4, 5), bit_of(0, 5)}) |
                   (compare(v01, v23) & PairMask{bit_of(0, 2), bit_of(1, 3)}) |
                   (compare(v23, v45) & PairMask{bit_of(2, 4), bit_of(3, 5)}) |
                   (compare(v01, v45) & PairMask{bit_of(0, 4), bit_of(1, 5)}) |
                   (compare(v01, v34) & PairMask{bit_of(0, 3), bit_of(1, 4)}) |
                   (compare(v23, v55) & PairMask{bit_of(2, 5), 0}));
}

/// Returns a bit for each edge whose first end precedes its second in the order of points.
unsigned ascending_edges(const SixValues& dx, const SixValues& dy, const SixValues& dz) {
    PairMask ascending{};
    for (std::size_t k = 0; k < 3; ++k) {
        const PairMask less =
            (dx[k] < 0) | ((dx[k] == 0) & ((dy[k] < 0) | ((dy[k] == 0) & (dz[k] < 0))));
        ascending |= less & PairMask{std::int64_t{1} << (2 * k), std::int64_t{2} << (2 * k)};
    }
    return bits_of(ascending);
}

/// Compares edges of equal length as longer() does: by the smaller end points, then by the larger
/// ones. The corners are distinct points, so it compares their ranks, which follow from the
/// ascending edges.
constexpr Comparisons compare_by_ends(unsigned ascending) {
    std::array<unsigned, 4> rank{};
    for (std::size_t e = 0; e < 6; ++e) {
        ++rank[cell_edges[e][(ascending >> e & 1U) != 0 ? 1 : 0]];
    }
    std::array<unsigned, 6> keys{};
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [low, high] = std::minmax(rank[cell_edges[e][0]], rank[cell_edges[e][1]]);
        keys[e] = 4 * low + high;
    }
    std::int64_t comparisons = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j) {
            if (keys[i] > keys[j]) comparisons |= bit_of(i, j);
        }
    }
    return static_cast<Comparisons>(comparisons);
}

constexpr std::array<Comparisons, 64> comparisons_by_ends = [] {
    std::array<Comparisons, 64> comparisons{};
    for (unsigned i = 0; i < 64; ++i) comparisons[i] = compare_by_ends(i);
    return comparisons;
}();

/// Flag in the result of comparisons: a length may have lost digits to underflow.
constexpr unsigned unsure = 1U << 15U;

PairMask has_small(const SixValues& lengths) {
    const Pair less = lengths[0] < lengths[1] ? lengths[0] : lengths[1];
    const Pair least = less < lengths[2] ? less : lengths[2];
    const PairMask is_small = least < Pair{least_sure_square, least_sure_square};
    return is_small & PairMask{unsure, unsure};
}

bool has_infinite(const SixValues& lengths) {
    const Pair sum = lengths[0] + lengths[1] + lengths[2];
    return sum[0] + sum[1] == std::numeric_limits<double>::infinity();
}

/// The comparisons for lengths that binary64 cannot represent.
[[gnu::cold]] Comparisons compare_one_by_one(const std::array<Point, 4>& corners) {
    std::array<Segment, 6> edges;
    for (std::size_t e = 0; e < 6; ++e) {
        edges[e] = {corners[cell_edges[e][0]], corners[cell_edges[e][1]]};
    }
    std::int64_t comparisons = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j) {
            if (longer(edges[i], edges[j])) comparisons |= bit_of(i, j);
        }
    }
    return static_cast<Comparisons>(comparisons);
}

}  // namespace

LengthOrder length_order(const IndexVector<VertexIndex, Point>& points, const CellVertices& cell) {
    const Point& a = points[cell[0]];
    const Point& b = points[cell[1]];
    const Point& c = points[cell[2]];
    const Point& d = points[cell[3]];
    const SixValues dx = differences(a.x, b.x, c.x, d.x);
    const SixValues dy = differences(a.y, b.y, c.y, d.y);
    const SixValues dz = differences(a.z, b.z, c.z, d.z);
    SixValues lengths;  // squared, as squared_length() rounds them
    for (std::size_t k = 0; k < 3; ++k) {
        lengths[k] = (dx[k] * dx[k] + dy[k] * dy[k]) + dz[k] * dz[k];
    }
    unsigned comparisons = compare_all(
        lengths, [](Pair u, Pair v) { return u > v; }, PairMask{});
    const unsigned ties = compare_all(
        lengths, [](Pair u, Pair v) { return u == v; }, has_small(lengths));
    if (ties != 0) {
        // If lengths overflow there are ties, or a single infinite length, which is the longest.
        if ((ties & unsure) != 0 || has_infinite(lengths)) {
            return PatternTable::get().order(compare_one_by_one({a, b, c, d}));
        }
        comparisons |= ties & comparisons_by_ends[ascending_edges(dx, dy, dz)];
    }
    return PatternTable::get().order(static_cast<Comparisons>(comparisons));
}

}  // namespace octetra::distributed
