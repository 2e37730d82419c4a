#include "pattern/patterns.hpp"

#include <algorithm>
#include <map>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {
namespace {

using LongestFirst = std::array<std::uint8_t, 6>;

constexpr std::array<EdgeMask, 4> edges_of_face{0b111000, 0b100110, 0b010101, 0b001011};

constexpr EdgeMask bit(std::size_t edge) { return static_cast<EdgeMask>(1U << edge); }

Comparisons comparisons_of(const LongestFirst& longest_first) {
    std::array<std::size_t, 6> rank{};
    for (std::size_t r = 0; r < 6; ++r) rank[longest_first[r]] = r;
    unsigned comparisons = 0;
    unsigned pair = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j, ++pair) {
            if (rank[i] < rank[j]) comparisons |= 1U << pair;
        }
    }
    return static_cast<Comparisons>(comparisons);
}

/// Returns the longest edge of a nonempty set.
std::uint8_t longest_in(EdgeMask set, const LongestFirst& longest_first) {
    for (const std::uint8_t e : longest_first) {
        if ((set & bit(e)) != 0) return e;
    }
    return 6;
}

/// Returns the closure of a single edge. The longest edge of a face is required by any marked edge
/// of the face, independently of others; so the closure of a set is the union of the closures of
/// its edges.
EdgeMask closure_of(std::size_t edge, const LongestFirst& longest_first) {
    EdgeMask closed = bit(edge);
    while (true) {
        EdgeMask next = closed;
        for (const EdgeMask face : edges_of_face) {
            if ((next & face) != 0) next |= bit(longest_in(face, longest_first));
        }
        if (next == closed) return closed;
        closed = next;
    }
}

/// A list of at most 8 children without dynamic allocation: the table needs two thousand.
class ChildList {
public:
    struct Child {
        std::array<PatternVertex, 4> places{};
        std::uint8_t halvings = 0;
    };
    void push_back(const Child& piece) { pieces_[count_++] = piece; }
    [[nodiscard]] Child& back() { return pieces_[count_ - 1]; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const Child* begin() const { return pieces_.data(); }
    [[nodiscard]] const Child* end() const { return pieces_.data() + count_; }

private:
    std::array<Child, 8> pieces_{};
    std::size_t count_ = 0;
};

ChildList undivided_cell() {
    ChildList pieces;
    pieces.push_back({.places = {0, 1, 2, 3}});
    return pieces;
}

/// Bisects each piece that has the edge. An original corner of a piece keeps its position until a
/// midpoint replaces it.
ChildList bisected(const ChildList& pieces, std::uint8_t edge) {
    const auto& [low, high] = cell_edges[edge];
    const auto midpoint = static_cast<PatternVertex>(4 + edge);
    ChildList halves;
    for (const ChildList::Child& piece : pieces) {
        halves.push_back(piece);
        if (piece.places[low] != low || piece.places[high] != high) continue;
        ChildList::Child half{piece.places, static_cast<std::uint8_t>(piece.halvings + 1)};
        half.places[high] = midpoint;
        halves.back() = half;
        half.places = piece.places;
        half.places[low] = midpoint;
        halves.push_back(half);
    }
    return halves;
}

/// A pattern encoded in two numbers for comparison, with four bits for each place.
using Code = std::array<std::uint64_t, 2>;

Code code_of(const Pattern& pattern) {
    Code code{};
    for (std::size_t k = 0; k < 8; ++k) {
        for (const PatternVertex place : pattern.children[k])
            code[k / 4] = code[k / 4] << 4U | place;
    }
    return code;
}

/// A cell bisected by its marked edges from longest to shortest, for each requested sequence;
/// sequences with a common prefix share its bisections. The first edge of a piece in the sequence
/// is its longest marked one, so this is the recursion of the rule, breadth first; each bisection
/// puts the two halves at the position of the piece, so the order of pieces is that of the
/// recursion.
class Bisections {
public:
    using Number = std::uint16_t;

    /// Returns the pattern's number among `patterns`, and adds the pattern if it is new.
    Number pattern_of(EdgeMask marked, const LongestFirst& longest_first,
                      std::vector<Pattern>& patterns, std::vector<Division>& divisions) {
        std::size_t at = 0;
        for (const std::uint8_t edge : longest_first) {
            if ((marked & bit(edge)) != 0) at = after(at, edge);
        }
        if (nodes_[at].pattern == none) {
            nodes_[at].pattern = number_of(nodes_[at].pieces, patterns, divisions);
        }
        return nodes_[at].pattern;
    }

private:
    static constexpr Number none = 0xffff;
    struct Node {
        ChildList pieces;
        std::array<Number, 6> after{};  ///< by the next edge; 0: not yet computed
        Number pattern = none;
    };

    std::size_t after(std::size_t node, std::uint8_t edge) {
        if (nodes_[node].after[edge] == 0) {
            nodes_[node].after[edge] = static_cast<Number>(nodes_.size());
            nodes_.push_back({bisected(nodes_[node].pieces, edge)});
        }
        return nodes_[node].after[edge];
    }

    Number number_of(const ChildList& pieces, std::vector<Pattern>& patterns,
                     std::vector<Division>& divisions) {
        Pattern pattern;
        pattern.child_count = static_cast<std::uint8_t>(pieces.size());
        std::ranges::transform(pieces, pattern.children.begin(), &ChildList::Child::places);
        const auto [place, fresh] =
            numbers_.try_emplace(code_of(pattern), static_cast<Number>(patterns.size()));
        if (fresh) {
            pattern.division = division_of(pieces, divisions);
            patterns.push_back(pattern);
        }
        return place->second;
    }

    static DivisionNumber division_of(const ChildList& pieces, std::vector<Division>& divisions) {
        Division division{.piece_count = static_cast<std::uint8_t>(pieces.size())};
        std::ranges::transform(pieces, division.halvings.begin(), &ChildList::Child::halvings);
        const auto found = std::ranges::find(divisions, division);
        const auto number = static_cast<DivisionNumber>(found - divisions.begin());
        if (found == divisions.end()) divisions.push_back(division);
        return number;
    }

    std::vector<Node> nodes_ = {{undivided_cell()}};
    std::map<Code, Number> numbers_;
};

}  // namespace

PatternTable::PatternTable()
    : order_by_comparisons_(std::size_t{1} << 15U, 0),
      closure_(order_count * mask_count),
      pattern_number_(order_count * mask_count, 0),
      divisions_{{Division{}}} {
    LongestFirst longest_first{0, 1, 2, 3, 4, 5};
    Bisections bisections;
    for (LengthOrder order = 0; order < order_count; ++order) {
        order_by_comparisons_[comparisons_of(longest_first)] = order;
        longest_edge_[order] = longest_first.front();
        for (const EdgeMask face : edges_of_face) {
            face_longest_edges_[order] |= bit(longest_in(face, longest_first));
        }
        for (std::size_t e = 0; e < 6; ++e) {
            const EdgeMask of_edge = closure_of(e, longest_first);
            for (std::size_t others = 0; others < bit(e); ++others) {
                closure_[order * mask_count + bit(e) + others] =
                    of_edge | closure_[order * mask_count + others];
            }
        }
        for (unsigned mask = 0; mask < mask_count; ++mask) {
            pattern_number_[order * mask_count + mask] = bisections.pattern_of(
                static_cast<EdgeMask>(mask), longest_first, patterns_, divisions_);
        }
        std::ranges::next_permutation(longest_first);
    }
}

}  // namespace octetra::distributed
