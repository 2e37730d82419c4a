#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>

/// All bisections of a cell, by the longest edges of its faces. Written for the certificate alone:
/// the engines have tables of their own.
namespace octetra::verify::shapes {

/// Squared lengths among the corners and midpoints of a cell, in units in which the cell has twice
/// its size. For the squared lengths l[e] of its edges, in the order of cell_edges, before that:
///  - 0 .. 5: half of edge e, or the segment parallel to it in a face: l[e]
///  - 6 .. 11: edge e: 4 l[e]
///  - 12 .. 23: from a corner to the midpoint of an opposite edge of a face: 12 + medians' number
///  - 24 .. 26: from the midpoint of edge e to that of edge 5 - e: 24 + e
inline constexpr std::size_t length_count = 27;

/// Returns the index in cell_edges of the edge between two corners.
[[nodiscard]] constexpr std::size_t edge_between(std::size_t a, std::size_t b) {
    constexpr std::array<std::array<std::uint8_t, 4>, 4> numbers{
        {{6, 0, 1, 2}, {0, 6, 3, 4}, {1, 3, 6, 5}, {2, 4, 5, 6}}};
    return numbers[a][b];
}

/// A corner and the edge of a face opposite to it, by the number of the median.
struct Median {
    std::uint8_t corner;
    std::uint8_t edge;
};
inline constexpr std::array<Median, 12> medians{{{0, 3},
                                                 {0, 4},
                                                 {0, 5},
                                                 {1, 1},
                                                 {1, 2},
                                                 {1, 5},
                                                 {2, 0},
                                                 {2, 2},
                                                 {2, 4},
                                                 {3, 0},
                                                 {3, 1},
                                                 {3, 3}}};

/// Returns all squared lengths, given those of the edges.
template <class Number>
[[nodiscard]] std::array<Number, length_count> all_lengths(const std::array<Number, 6>& l) {
    std::array<Number, length_count> all;
    for (std::size_t e = 0; e < 6; ++e) {
        all[e] = l[e];
        all[6 + e] = 4 * l[e];
    }
    for (std::size_t k = 0; k < 12;
         ++k) {  // |2a - (b + c)|^2 = 2 |a - b|^2 + 2 |a - c|^2 - |b - c|^2
        const auto [a, edge] = medians[k];
        const auto [b, c] = cell_edges[edge];
        all[12 + k] = 2 * (l[edge_between(a, b)] + l[edge_between(a, c)]) - l[edge];
    }
    for (std::size_t e = 0; e < 3; ++e) {  // |(a + b) - (c + d)|^2
        const auto [a, b] = cell_edges[e];
        const auto [c, d] = cell_edges[5 - e];
        all[24 + e] = (l[edge_between(a, c)] + l[edge_between(a, d)] - l[e]) +
                      (l[edge_between(b, c)] + l[edge_between(b, d)] - l[5 - e]);
    }
    return all;
}

/// A part of a cell.
struct Piece {
    /// Corners of the cell (0 .. 3) and midpoints of edges e (4 + e).
    std::array<std::uint8_t, 4> points{};
    std::array<std::uint8_t, 6> lengths{};  ///< of its edges: indices of all_lengths()
    std::uint8_t depth = 0;                 ///< number of bisections
};

/// A cell's edges, from the longest to the shortest.
using LongestFirst = std::array<std::uint8_t, 6>;

/// The longest edge of each face, in the order of cell_faces, as a position (0 .. 2) among the
/// edges of the face in ascending order; base 3.
using FaceKey = std::uint8_t;
inline constexpr std::size_t face_key_count = 81;

[[nodiscard]] FaceKey face_key(const LongestFirst& order);

struct Pattern {
    std::array<Piece, 8> children;  ///< if all edges are bisected
    /// The pieces of all other closed sets of edges, each once, except the cell itself and its
    /// eight children.
    std::vector<Piece> transition_cells;
};

/// Bisects a cell whose edges have this order by every closed set.
[[nodiscard]] Pattern make_pattern(const LongestFirst& order);

/// Returns the pattern of a cell whose faces have these longest edges, or null if no order of edges
/// makes them the longest. By a theorem of bisection, which a test confirms for all 720 orders,
/// these edges determine the pattern.
[[nodiscard]] const Pattern* pattern_of(FaceKey key);

}  // namespace octetra::verify::shapes
