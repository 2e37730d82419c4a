#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/distributed/entity_transfer.hpp>

/// All bisections of a single cell, computed once from the rule.
namespace octetra::distributed {

/// A set of the cell's edges (numbered as in cell_edges) or of a triangle's, one bit each.
using EdgeMask = std::uint8_t;

inline constexpr EdgeMask all_edges = 0b111111;  ///< of a cell

/// Returns whether a set of a cell's edges is empty or complete: such a set is closed for any order
/// of lengths.
[[nodiscard]] constexpr bool is_all_or_none(EdgeMask edges) {
    return edges == 0 || edges == all_edges;
}

/// A position in a bisected cell: a corner (0..3) or the midpoint of edge k (4 + k).
using PatternVertex = std::uint8_t;

/// A number of a division in PatternTable::divisions(); 0 is that of an unbisected cell.
using DivisionNumber = std::uint8_t;

/// The children of a cell in canonical order.
struct Pattern {
    std::uint8_t child_count = 0;
    DivisionNumber division = 0;
    std::array<std::array<PatternVertex, 4>, 8> children{};
};

/// The order of a cell's six edges by length, as a number below `order_count`.
using LengthOrder = std::uint16_t;
inline constexpr std::size_t order_count = 720;

/// The comparisons of the lengths of the 15 pairs (i, j), i < j, in lexicographic order: the bit of
/// a pair is set if edge i is longer than edge j.
using Comparisons = std::uint16_t;

class PatternTable {
public:
    /// Built on first use, in less than a millisecond.
    static const PatternTable& get() {
        static const PatternTable table;
        return table;
    }

    [[nodiscard]] LengthOrder order(Comparisons comparisons) const {
        return order_by_comparisons_[comparisons];
    }
    [[nodiscard]] std::size_t longest_edge(LengthOrder order) const { return longest_edge_[order]; }
    /// Returns the longest edges of the four faces.
    [[nodiscard]] EdgeMask face_longest_edges(LengthOrder order) const {
        return face_longest_edges_[order];
    }
    /// Returns the smallest set that contains `marked` and the longest edge of every face that has
    /// an edge in the set.
    [[nodiscard]] EdgeMask closure(LengthOrder order, EdgeMask marked) const {
        return closure_[order * mask_count + marked];
    }
    /// Returns the bisection of a cell with these edges marked. The set need not be closed: see
    /// TransitionCells.
    [[nodiscard]] const Pattern& pattern(LengthOrder order, EdgeMask marked) const {
        return patterns_[pattern_number_[order * mask_count + marked]];
    }
    [[nodiscard]] const std::vector<Division>& divisions() const { return divisions_; }

private:
    static constexpr std::size_t mask_count = 64;

    PatternTable();

    std::vector<LengthOrder> order_by_comparisons_;
    std::array<std::uint8_t, order_count> longest_edge_{};
    std::array<EdgeMask, order_count> face_longest_edges_{};
    std::vector<EdgeMask> closure_;
    std::vector<std::uint16_t> pattern_number_;
    std::vector<Pattern> patterns_;
    std::vector<Division> divisions_;
};

}  // namespace octetra::distributed
