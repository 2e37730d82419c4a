#include "shapes/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <octetra/core/mesh.hpp>

#include "shapes/patterns.hpp"

namespace octetra::verify::shapes {

void Extremes::add_solid_angles(const RoundedPiece& piece) {
    const std::array<double, 6>& l = piece.lengths;
    double sum = 0;
    for (const double length : l) sum += length;
    min_ratio_ = std::min(min_ratio_, piece.volume * piece.volume / (sum * sum * sum));

    std::array<double, 6> root{};
    for (std::size_t e = 0; e < 6; ++e) root[e] = std::sqrt(l[e]);
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto& [p, q, r] = cell_faces[corner];
        const std::size_t a = edge_between(corner, p);
        const std::size_t b = edge_between(corner, q);
        const std::size_t c = edge_between(corner, r);
        const double product = 2 * root[a] * root[b] * root[c];
        const double l_ab = l[edge_between(p, q)];
        const double l_ac = l[edge_between(p, r)];
        const double l_bc = l[edge_between(q, r)];
        const double twice = product + (l[a] + l[b] - l_ab) * root[c] +
                             (l[a] + l[c] - l_ac) * root[b] + (l[b] + l[c] - l_bc) * root[a];
        const double sums = product + (l[a] + l[b] + l_ab) * root[c] +
                            (l[a] + l[c] + l_ac) * root[b] + (l[b] + l[c] + l_bc) * root[a];
        const double at_most = twice + 0x1p-48 * sums;
        if (at_most <= 0) continue;  // the solid angle exceeds pi
        min_half_tangent_ = std::min(min_half_tangent_, 2 * piece.volume / at_most);
    }
}

ShapeBounds Extremes::bounds() const {
    constexpr double degrees = 180 / std::numbers::pi;
    constexpr double less = 1 - 0x1p-46;  // covers the functions of the standard library
    constexpr double more = 1 + 0x1p-46;
    return {.min_dihedral = less * degrees * std::atan2(1.0, max_cotangent_),
            .max_dihedral = std::min(180.0, more * degrees * std::atan2(1.0, min_cotangent_)),
            .min_eta = less * std::cbrt(432 * min_ratio_),
            .min_solid = less * 2 * std::atan(min_half_tangent_)};
}

}  // namespace octetra::verify::shapes
