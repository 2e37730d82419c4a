#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <octetra/verify/certify_shapes.hpp>

namespace octetra::verify::shapes {

/// Squared lengths of the edges of a piece, and six times its volume, in floating point: each with
/// a relative error of at most 2^-51.
struct RoundedPiece {
    std::array<double, 6> lengths{};
    double volume = 0;
};

/// Bounds of the angles and eta of all pieces that were added.
///
/// Errors, with u = 2^-53. At an edge e of a tetrahedron whose faces continue with the vectors a
/// and b, c = (e.e)(a.b) - (e.a)(e.b) and s = |e| 6V give the dihedral angle: its cotangent is c /
/// s. Dot products follow from squared lengths l, as 2 e.a = l(e) + l(a) - l(e - a). If K is the
/// value of 4 c with all subtractions replaced by additions, the computed 4 c has an error of at
/// most 20 u K, and the cotangent one of at most 26 u K / 4 s, for which 32 u K / 4 s is used.
/// If that exceeds 2^-40 (1 + |cot|), and the angle may be the extreme one, 4 c is computed from
/// integers: the cotangent then has a relative error of at most 16 u. The solid angle at a corner
/// with the vectors a, b, c is 2 atan(6V / D), D = |a||b||c| + (a.b)|c| + (a.c)|b| + (b.c)|a|; the
/// error of D is bounded in the same way, and no integers are used.
class Extremes {
public:
    /// Adds a piece; exactly(k) must return 4 c at edge k, computed from integers and then rounded.
    void add(const RoundedPiece& piece, auto&& exactly) {
        add_dihedral_angles(piece, exactly);
        add_solid_angles(piece);
    }

    /// The bounds, rounded outward.
    [[nodiscard]] ShapeBounds bounds() const;

private:
    void add_dihedral_angles(const RoundedPiece& piece, auto&& exactly);
    void add_solid_angles(const RoundedPiece& piece);

    double max_cotangent_ = -std::numeric_limits<double>::infinity();
    double min_cotangent_ = std::numeric_limits<double>::infinity();
    double min_half_tangent_ = std::numeric_limits<double>::infinity();
    double min_ratio_ = std::numeric_limits<double>::infinity();  ///< (6V)^2 / (sum of lengths)^3
};

/// The lengths at edge k of a tetrahedron: of the edge, of the two edges a, b at its first end that
/// lie in its two faces, of the two at its second end, and of the edge opposite.
struct AtEdge {
    std::size_t e, a, b, e_a, e_b, opposite;
};
inline constexpr std::array<AtEdge, 6> at_edge{{{0, 1, 2, 3, 4, 5},
                                                {1, 0, 2, 3, 5, 4},
                                                {2, 0, 1, 4, 5, 3},
                                                {3, 0, 4, 1, 5, 2},
                                                {4, 0, 3, 2, 5, 1},
                                                {5, 1, 3, 2, 4, 0}}};

/// Returns 4 c at an edge: see Extremes.
template <class Number>
[[nodiscard]] Number four_cosines(const std::array<Number, 6>& l, std::size_t edge) {
    const auto [e, a, b, e_a, e_b, opposite] = at_edge[edge];
    return 2 * l[e] * (l[a] + l[b] - l[opposite]) - (l[e] + l[a] - l[e_a]) * (l[e] + l[b] - l[e_b]);
}

void Extremes::add_dihedral_angles(const RoundedPiece& piece, auto&& exactly) {
    const std::array<double, 6>& l = piece.lengths;
    for (std::size_t edge = 0; edge < 6; ++edge) {
        const auto [e, a, b, e_a, e_b, opposite] = at_edge[edge];
        const double four_sines = 4 * std::sqrt(l[e]) * piece.volume;
        const double sums = 2 * l[e] * (l[a] + l[b] + l[opposite]) +
                            (l[e] + l[a] + l[e_a]) * (l[e] + l[b] + l[e_b]);
        double cotangent = four_cosines(l, edge) / four_sines;
        double error = 0x1p-48 * sums / four_sines;
        if (cotangent + error <= max_cotangent_ && cotangent - error >= min_cotangent_) continue;
        if (error > 0x1p-40 * (1 + std::abs(cotangent))) {
            cotangent = exactly(edge) / four_sines;
            error = 0x1p-49 * std::abs(cotangent);
        }
        max_cotangent_ = std::max(max_cotangent_, cotangent + error);
        min_cotangent_ = std::min(min_cotangent_, cotangent - error);
    }
}

}  // namespace octetra::verify::shapes
