#include "pattern/coarser_pattern.hpp"

#include <numeric>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {
namespace {

using Vector = std::array<int, 4>;

/// Twice the barycentric coordinates.
Vector coordinates(Place place) {
    Vector vector{};
    if (place < 4) {
        vector[place] = 2;
    } else {
        for (const std::uint8_t corner : cell_edges[place - 4U]) vector[corner] = 1;
    }
    return vector;
}

int determinant(const std::array<Vector, 4>& rows) {
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
        const auto& [a, b, c] = std::array{rows[1], rows[2], rows[3]};
        return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
               a[k] * (b[i] * c[j] - b[j] * c[i]);
    };
    return rows[0][0] * minor(1, 2, 3) - rows[0][1] * minor(0, 2, 3) + rows[0][2] * minor(0, 1, 3) -
           rows[0][3] * minor(0, 1, 2);
}

/// Does the centroid of one lie in the other?
bool is_inside(const std::array<Place, 4>& inner, const std::array<Place, 4>& outer) {
    Vector centroid{};
    std::array<Vector, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = coordinates(outer[k]);
        const Vector corner = coordinates(inner[k]);
        for (std::size_t i = 0; i < 4; ++i) centroid[i] += corner[i];
    }
    const int whole = determinant(corners);
    for (std::size_t k = 0; k < 4; ++k) {
        auto part = corners;
        part[k] = centroid;
        if (determinant(part) * whole <= 0) return false;
    }
    return true;
}

}  // namespace

CoarserPattern coarser_pattern(LengthOrder order, EdgeMask more, EdgeMask fewer) {
    const PatternTable& table = PatternTable::get();
    const Pattern& fine = table.pattern(order, more);
    CoarserPattern result;
    result.same_child.fill(CoarserPattern::none);
    if (fewer == more) {
        result.child_count = fine.child_count;
        std::iota(result.child_around.begin(), result.child_around.end(), std::uint8_t{0});
        std::iota(result.same_child.begin(), result.same_child.end(), std::uint8_t{0});
        return result;
    }
    const auto& halvings = table.divisions()[fine.division].halvings;
    if (fewer == 0) {
        result.child_count = 1;
        result.halvings = halvings;
        return result;
    }
    const Pattern& coarse = table.pattern(order, fewer);
    const auto& halvings_of_coarse = table.divisions()[coarse.division].halvings;
    result.child_count = coarse.child_count;
    for (std::uint8_t j = 0; j < coarse.child_count; ++j) {
        for (std::uint8_t i = 0; i < fine.child_count; ++i) {
            if (!is_inside(fine.children[i], coarse.children[j])) continue;
            result.child_around[i] = j;
            result.halvings[i] = static_cast<std::uint8_t>(halvings[i] - halvings_of_coarse[j]);
            if (fine.children[i] == coarse.children[j]) result.same_child[j] = i;
        }
    }
    return result;
}

}  // namespace octetra::distributed
