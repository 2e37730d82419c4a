#include "select/background_cells.hpp"

#include <bit>
#include <cstdint>
#include <functional>
#include <optional>

#include <octetra/core/triangle_tree.hpp>

#include "mark/selection_bounds.hpp"

namespace octetra::distributed {
namespace {

struct Vector {
    double x, y, z;
};

Vector from_to(const Point& a, const Point& b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }
double inner(const Vector& u, const Vector& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
double determinant(const Vector& u, const Vector& v, const Vector& w) {
    return inner(u, {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x});
}

/// Returns the sum of values by weights, whose sum is about 1, within the range of the values.
template <std::size_t N>
double interpolated(const std::array<double, N>& values, const std::array<double, N>& weights) {
    double sum = 0;
    for (std::size_t k = 0; k < N; ++k) sum += weights[k] * values[k];
    const auto [least, greatest] = std::ranges::minmax(values);
    return std::clamp(sum, least, greatest);
}

/// Returns 0 for a numerator of 0 over 0.
double share(double numerator, double denominator) {
    return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0;
}

/// Returns the weights of the corners of a triangle at its closest point to p (Ericson, Real-Time
/// Collision Detection, 5.1.5).
std::array<double, 3> closest_weights(const Point& p, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const Vector ab = from_to(a, b);
    const Vector ac = from_to(a, c);
    const Vector ap = from_to(a, p);
    const double b_of_a = inner(ab, ap);
    const double c_of_a = inner(ac, ap);
    if (b_of_a <= 0 && c_of_a <= 0) return {1, 0, 0};
    const Vector bp = from_to(b, p);
    const double b_of_b = inner(ab, bp);
    const double c_of_b = inner(ac, bp);
    if (b_of_b >= 0 && c_of_b <= b_of_b) return {0, 1, 0};
    const Vector cp = from_to(c, p);
    const double b_of_c = inner(ab, cp);
    const double c_of_c = inner(ac, cp);
    if (c_of_c >= 0 && b_of_c <= c_of_c) return {0, 0, 1};
    const double of_c = b_of_a * c_of_b - b_of_b * c_of_a;
    if (of_c <= 0 && b_of_a >= 0 && b_of_b <= 0) {
        const double t = share(b_of_a, b_of_a - b_of_b);
        return {1 - t, t, 0};
    }
    const double of_b = b_of_c * c_of_a - b_of_a * c_of_c;
    if (of_b <= 0 && c_of_a >= 0 && c_of_c <= 0) {
        const double t = share(c_of_a, c_of_a - c_of_c);
        return {1 - t, 0, t};
    }
    const double of_a = b_of_b * c_of_c - b_of_c * c_of_b;
    if (of_a <= 0 && c_of_b >= b_of_b && b_of_c >= c_of_c) {
        const double t = share(c_of_b - b_of_b, (c_of_b - b_of_b) + (b_of_c - c_of_c));
        return {0, 1 - t, t};
    }
    const double sum = of_a + of_b + of_c;
    const double v = share(of_b, sum);
    const double w = share(of_c, sum);
    return {1 - v - w, v, w};
}

/// Rounds a number of at least 0 to 32 binary digits.
double rounded(double number) {
    constexpr std::uint64_t unit = std::uint64_t{1} << 21U;
    const auto bits = std::bit_cast<std::uint64_t>(number);
    return std::bit_cast<double>((bits + unit / 2) & ~(unit - 1));
}

ClosestValue closest_of_triangle(const Point& p, const Triangle& triangle,
                                 const std::array<double, 3>& values) {
    const auto weights = closest_weights(p, triangle);
    const auto& [a, b, c] = triangle;
    const Vector ab = from_to(a, b);
    const Vector ac = from_to(a, c);
    const Vector ap = from_to(a, p);
    const auto& [u, v, w] = weights;
    const Vector rest{ap.x - v * ab.x - w * ac.x, ap.y - v * ab.y - w * ac.y,
                      ap.z - v * ab.z - w * ac.z};
    return {rounded(inner(rest, rest)), interpolated(values, weights)};
}

bool is_in_box(const Point& p, const Box& box) {
    return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y &&
           box.low.z <= p.z && p.z <= box.high.z;
}

/// Returns the value at a point of the cell, or nothing for a point outside.
std::optional<double> value_inside(const Point& p, const BackgroundCell& cell) {
    if (!is_in_box(p, box_of(cell.corners))) return {};
    const auto& [a, b, c, d] = cell.corners;
    const Vector ab = from_to(a, b);
    const Vector ac = from_to(a, c);
    const Vector ad = from_to(a, d);
    const Vector ap = from_to(a, p);
    const double volume = determinant(ab, ac, ad);
    const double of_b = determinant(ap, ac, ad) / volume;
    const double of_c = determinant(ab, ap, ad) / volume;
    const double of_d = determinant(ab, ac, ap) / volume;
    const double of_a = determinant(from_to(p, b), from_to(p, c), from_to(p, d)) / volume;
    // Comparisons with NaN, of a cell that is flat after rounding, are false.
    if (!(of_a >= 0 && of_b >= 0 && of_c >= 0 && of_d >= 0)) return {};
    return interpolated<4>(cell.values, {of_a, of_b, of_c, of_d});
}

}  // namespace

ClosestValue closest_value(const Point& p, const BackgroundCell& cell) {
    if (const auto value = value_inside(p, cell)) return {0, *value};
    ClosestValue closest;
    for (const auto& [i, j, k] : cell_faces) {
        const ClosestValue found =
            closest_of_triangle(p, {cell.corners[i], cell.corners[j], cell.corners[k]},
                                {cell.values[i], cell.values[j], cell.values[k]});
        if (found < closest) closest = found;
    }
    return closest;
}

Box BackgroundCells::BoxOfCell::operator()(const BackgroundCell& cell) const {
    return box_of(cell.corners);
}

ClosestValue BackgroundCells::closest(const Point& p, ClosestValue bound) const {
    // Most points are in a cell: then no other cell is closer.
    double limit = limit_of_boxes(0);
    bool is_inside = false;
    tree_.visit_near(p, limit, [&](const BackgroundCell& cell) {
        const auto value = value_inside(p, cell);
        if (!value) return;
        is_inside = true;
        bound = std::min(bound, {0, *value}, std::less<>());
    });
    if (is_inside) return bound;
    limit = limit_of_boxes(slightly_more(bound.squared));
    tree_.visit_near(p, limit, [&](const BackgroundCell& cell) {
        if (least_squared_distance(p, box_of(cell.corners)) > limit) return;
        const ClosestValue found = closest_value(p, cell);
        if (!(found < bound)) return;
        bound = found;
        limit = limit_of_boxes(slightly_more(bound.squared));
    });
    return bound;
}

}  // namespace octetra::distributed
