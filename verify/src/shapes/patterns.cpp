#include "shapes/patterns.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "mesh/face_edges.hpp"

namespace octetra::verify::shapes {
namespace {

using EdgeSet = unsigned;

constexpr bool contains(EdgeSet set, std::size_t edge) { return (set >> edge & 1U) != 0; }

/// The longest edge of a face.
std::uint8_t longest_of_face(std::size_t face, const LongestFirst& order) {
    const auto& edges = face_edges[face];
    for (const std::uint8_t edge : order) {
        if (edge == edges[0] || edge == edges[1] || edge == edges[2]) return edge;
    }
    return edges[0];  // not reached: the order has all edges
}

/// Returns whether the longest edge of every face with an edge of the set is in the set.
bool is_closed(EdgeSet set, const LongestFirst& order) {
    for (std::size_t f = 0; f < 4; ++f) {
        const bool has_any = std::ranges::any_of(
            face_edges[f], [&](std::uint8_t edge) { return contains(set, edge); });
        if (has_any && !contains(set, longest_of_face(f, order))) return false;
    }
    return true;
}

/// Returns the index in all_lengths() of the length between two of a cell's corners and midpoints.
std::uint8_t length_between(std::uint8_t p, std::uint8_t q) {
    if (p > q) std::swap(p, q);
    const auto number = [](std::size_t n) { return static_cast<std::uint8_t>(n); };
    if (q < 4) return number(6 + edge_between(p, q));
    const auto [c, d] = cell_edges[q - 4U];
    if (p < 4) {
        if (p == c || p == d) return number(q - 4U);
        std::size_t m = 0;
        while (medians[m].corner != p || medians[m].edge != q - 4) ++m;
        return number(12 + m);
    }
    if (p - 4 + q - 4 == 5) return number(24U + p - 4);
    const auto [a, b] = cell_edges[p - 4U];  // the edges share a corner
    if (a == c) return number(edge_between(b, d));
    if (a == d) return number(edge_between(b, c));
    return b == c ? number(edge_between(a, d)) : number(edge_between(a, c));
}

/// Bisects the piece by its longest edge that is in the set, then each half.
void bisect(const Piece& piece, EdgeSet set, const LongestFirst& order,
            std::vector<Piece>& pieces) {
    for (const std::uint8_t edge : order) {
        const auto [a, b] = cell_edges[edge];
        if (!contains(set, edge) || piece.points[a] != a || piece.points[b] != b) continue;
        const auto midpoint = static_cast<std::uint8_t>(4 + edge);
        Piece half = piece;
        ++half.depth;
        half.points[b] = midpoint;
        bisect(half, set, order, pieces);
        half.points = piece.points;
        half.points[a] = midpoint;
        bisect(half, set, order, pieces);
        return;
    }
    pieces.push_back(piece);
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        pieces.back().lengths[k] = length_between(piece.points[i], piece.points[j]);
    }
}

std::vector<Piece> pieces_of(EdgeSet set, const LongestFirst& order) {
    std::vector<Piece> pieces;
    bisect({.points = {0, 1, 2, 3}}, set, order, pieces);
    return pieces;
}

bool have_same_points(const Piece& a, const Piece& b) {
    return std::ranges::is_permutation(a.points, b.points);
}

bool is_among(const Piece& piece, const auto& pieces) {
    return std::ranges::any_of(pieces, [&](const Piece& p) { return have_same_points(p, piece); });
}

std::vector<std::optional<Pattern>> make_patterns() {
    std::vector<std::optional<Pattern>> patterns(face_key_count);
    LongestFirst order{};
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    do {
        std::optional<Pattern>& pattern = patterns[face_key(order)];
        if (!pattern) pattern = make_pattern(order);
    } while (std::ranges::next_permutation(order).found);
    return patterns;
}

}  // namespace

FaceKey face_key(const LongestFirst& order) {
    std::size_t key = 0;
    for (std::size_t f = 4; f-- > 0;) {
        const auto found = std::ranges::find(face_edges[f], longest_of_face(f, order));
        key = 3 * key + static_cast<std::size_t>(found - face_edges[f].begin());
    }
    return static_cast<FaceKey>(key);
}

Pattern make_pattern(const LongestFirst& order) {
    constexpr EdgeSet all = 0b111111;
    Pattern pattern;
    std::ranges::copy(pieces_of(all, order), pattern.children.begin());
    for (EdgeSet set = 1; set < all; ++set) {
        if (!is_closed(set, order)) continue;
        for (const Piece& piece : pieces_of(set, order)) {
            if (is_among(piece, pattern.children)) continue;
            if (is_among(piece, pattern.transition_cells)) continue;
            pattern.transition_cells.push_back(piece);
        }
    }
    return pattern;
}

const Pattern* pattern_of(FaceKey key) {
    static const std::vector<std::optional<Pattern>> patterns = make_patterns();
    return patterns[key] ? &*patterns[key] : nullptr;
}

}  // namespace octetra::verify::shapes
