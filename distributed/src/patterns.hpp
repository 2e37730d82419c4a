#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

/// Every way in which one cell can be bisected, worked out from the rule when it is first met.
namespace octetra::distributed {

/// A set of the cell's edges (numbered as in cell_edges) or of a triangle's, one bit each.
using EdgeMask = std::uint8_t;

/// Of a cell's edges: such a set is closed in any order of lengths.
[[nodiscard]] constexpr bool is_all_or_none(EdgeMask edges) {
    return edges == 0 || edges == 0b111111;
}

/// A corner (0..3) or the midpoint of edge k (4 + k).
using Place = std::uint8_t;

/// The children of a cell in canonical order.
struct Pattern {
    std::uint8_t child_count = 0;
    std::array<std::array<Place, 4>, 8> children{};
};

/// The order of a cell's six edges by length, as a number below `order_count`: the first order that
/// a PatternTable was asked for is 0.
using LengthOrder = std::uint16_t;
inline constexpr std::size_t order_count = 720;

/// So many different patterns there are.
inline constexpr std::size_t pattern_count = 535;

/// Which of two edges is the longer one, for each of the 15 pairs (i, j), i < j, in lexicographic
/// order: the bit of a pair is set if edge i is longer than edge j.
using Comparisons = std::uint16_t;

class PatternTable {
public:
    /// This thread's. An order takes some microseconds when it is first asked for: most meshes have
    /// few of the 720, and small ones are refined in less time than it takes to make all.
    static PatternTable& get() {
        static thread_local PatternTable table;
        return table;
    }

    /// The comparisons must be those of an order.
    [[nodiscard]] LengthOrder order(Comparisons comparisons) {
        const LengthOrder known = order_by_comparisons_[comparisons];
        return known != order_count ? known : add(comparisons);
    }
    [[nodiscard]] std::size_t longest_edge(LengthOrder order) const { return longest_edge_[order]; }
    /// The longest edges of the four faces.
    [[nodiscard]] EdgeMask face_longest_edges(LengthOrder order) const {
        return face_longest_edges_[order];
    }
    /// The least set with all of `selected` and the longest edge of every face that it touches.
    [[nodiscard]] EdgeMask closure(LengthOrder order, EdgeMask selected) const {
        return closure_[order * mask_count + selected];
    }
    /// How a cell with these edges selected is bisected. The set must be closed.
    [[nodiscard]] const Pattern& pattern(LengthOrder order, EdgeMask selected) const {
        return patterns_[pattern_number_[order * mask_count + selected]];
    }

private:
    /// A pattern as two numbers, for comparison: four bits for each place.
    using Code = std::array<std::uint64_t, 2>;

    static constexpr std::size_t mask_count = 64;

    PatternTable();
    LengthOrder add(Comparisons comparisons);
    std::uint16_t number_of(const Pattern& pattern);
    static Code code_of(const Pattern& pattern);

    std::vector<LengthOrder> order_by_comparisons_;
    std::array<std::uint8_t, order_count> longest_edge_{};
    std::array<EdgeMask, order_count> face_longest_edges_{};
    std::vector<EdgeMask> closure_;
    std::vector<std::uint16_t> pattern_number_;
    std::vector<Pattern> patterns_;  ///< different ones; there is room for all, so they never move
    std::map<Code, std::uint16_t> number_by_code_;
    LengthOrder known_orders_ = 0;
};

}  // namespace octetra::distributed
