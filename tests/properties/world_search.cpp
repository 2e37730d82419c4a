#include "properties/world_search.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <octetra/core/orientation.hpp>

#include "properties/census.hpp"
#include "properties/draw.hpp"

namespace octetra::properties {
namespace {

constexpr std::size_t extent = std::size_t{1} << 20U;

using Points = std::vector<Point>;

Points anywhere(std::size_t count, Draw& draw) {
    const auto coordinate = [&] { return static_cast<double>(draw.below(extent)); };
    Points points;
    for (std::size_t v = 0; v < count; ++v) {
        points.push_back({coordinate(), coordinate(), coordinate()});
    }
    return points;
}

/// Moves one or all points by up to a random power of two; coordinates wrap around in the cube.
Points moved(Points points, Draw& draw) {
    const std::size_t most = extent >> draw.below(16);
    const auto move = [&](double& x) {
        const std::size_t shift = draw.below(2 * most + 1) + 2 * extent - most;
        x = static_cast<double>((static_cast<std::size_t>(x) + shift) % extent);
    };
    const bool one = draw.chance(0.5);
    const std::size_t the_one = draw.below(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (one && v != the_one) continue;
        move(points[v].x);
        move(points[v].y);
        move(points[v].z);
    }
    return points;
}

/// Sometimes draws new points; else moves those of a previous world, half of the time of a recent
/// one.
Points next_try(const std::vector<Points>& found, std::size_t vertices, Draw& draw) {
    constexpr std::size_t latest = 300;
    if (found.empty() || draw.below(64) == 0) return anywhere(vertices, draw);
    const std::size_t back = draw.chance(0.5) ? latest : found.size();
    return moved(found[found.size() - 1 - draw.below(std::min(back, found.size()))], draw);
}

using Cell = std::array<std::size_t, 4>;

/// Returns whether the plane through these three points has all remaining points of a on one side
/// and all of b on the other.
bool separates(const Points& points, const std::vector<std::size_t>& plane, const Cell& a,
               const Cell& b) {
    int side_of_a = 0;
    for (const auto& [cell, sign] : {std::pair(&a, 1), std::pair(&b, -1)}) {
        for (const std::size_t v : *cell) {
            if (std::ranges::find(plane, v) != plane.end()) continue;
            const int side =
                sign * orientation(points[plane[0]], points[plane[1]], points[plane[2]], points[v]);
            if (side == 0 || side == -side_of_a) return false;
            side_of_a = side;
        }
    }
    return true;
}

/// Returns whether two cells have nothing in common but the span of their common corners. Tries the
/// planes through all common corners and as many others as make three.
bool are_separable(const Points& points, const Cell& a, const Cell& b) {
    std::vector<std::size_t> common;
    std::vector<std::size_t> others;
    for (const std::size_t v : a) {
        (std::ranges::find(b, v) == b.end() ? others : common).push_back(v);
    }
    std::ranges::copy_if(b, std::back_inserter(others), [&](std::size_t v) {
        return std::ranges::find(common, v) == common.end();
    });
    std::vector<char> is_on_plane(others.size(), 0);
    std::fill_n(is_on_plane.rbegin(), 3 - common.size(), char{1});
    do {
        std::vector<std::size_t> plane = common;
        for (std::size_t i = 0; i < others.size(); ++i) {
            if (is_on_plane[i] != 0) plane.push_back(others[i]);
        }
        if (separates(points, plane, a, b)) return true;
    } while (std::ranges::next_permutation(is_on_plane).found);
    return false;
}

bool is_reached(const CombinationCounts& goal, const Census& census) {
    const CombinationCounts met = counts(census);
    return met[0] >= goal[0] && met[1] >= goal[1] && met[2] >= goal[2];
}

}  // namespace

bool is_valid(const std::vector<Point>& points, const Complex& complex) {
    for (const auto& [a, b, c, d] : complex) {
        if (orientation(points[a], points[b], points[c], points[d]) == 0) return false;
    }
    for (std::size_t i = 0; i < complex.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (!are_separable(points, complex[i], complex[k])) return false;
        }
    }
    return true;
}

std::vector<std::vector<Point>> find_worlds(const Complex& complex, const CombinationCounts& goal,
                                            std::size_t patience) {
    Census census = empty_census(complex, goal[2] > 0);
    std::vector<Points> found;
    Draw draw(1);
    for (std::size_t failed_moves = 0; failed_moves < patience && !is_reached(goal, census);
         ++failed_moves) {
        Points points = next_try(found, vertex_count(complex), draw);
        if (!has_new(census, points) || !is_valid(points, complex)) continue;
        note(census, points);
        found.push_back(std::move(points));
        failed_moves = 0;
    }
    return found;
}

}  // namespace octetra::properties
