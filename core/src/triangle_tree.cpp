#include <octetra/core/triangle_tree.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octetra {
namespace {

Point minus(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot_of(const Point& u, const Point& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
Point cross_of(const Point& u, const Point& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double squared_distance_to_segment(const Point& p, const Point& a, const Point& b) {
    const Point along = minus(b, a);
    const Point to = minus(p, a);
    const double square = dot_of(along, along);
    const double t = square > 0 ? std::clamp(dot_of(to, along) / square, 0.0, 1.0) : 0;
    const Point rest{to.x - t * along.x, to.y - t * along.y, to.z - t * along.z};
    return dot_of(rest, rest);
}

std::vector<Triangle> with_sorted_corners(std::vector<Triangle> triangles) {
    for (Triangle& triangle : triangles) std::ranges::sort(triangle);
    return triangles;
}

}  // namespace

double squared_distance(const Point& p, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const double to_edges =
        std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, a, c),
                  squared_distance_to_segment(p, b, c)});
    const Point normal = cross_of(minus(b, a), minus(c, a));
    const double square = dot_of(normal, normal);
    const auto is_left_of = [&](const Point& from, const Point& to) {
        return dot_of(cross_of(minus(to, from), minus(p, from)), normal) >= 0;
    };
    if (!(square > 0) || !is_left_of(a, b) || !is_left_of(b, c) || !is_left_of(c, a)) {
        return to_edges;
    }
    const double height = dot_of(normal, minus(p, a));
    return std::min(to_edges, height * height / square);
}

double least_squared_distance(const Point& p, const Box& box) {
    const Point nearest{std::clamp(p.x, box.low.x, box.high.x),
                        std::clamp(p.y, box.low.y, box.high.y),
                        std::clamp(p.z, box.low.z, box.high.z)};
    const Point d = minus(p, nearest);
    return dot_of(d, d);
}

double greatest_squared_distance(const Point& p, const Box& box) {
    const auto farther = [](double c, double low, double high) {
        return std::max(std::abs(c - low), std::abs(c - high));
    };
    const Point d{farther(p.x, box.low.x, box.high.x), farther(p.y, box.low.y, box.high.y),
                  farther(p.z, box.low.z, box.high.z)};
    return dot_of(d, d);
}

double limit_of_boxes(double squared) {
    // The computed distance to a triangle differs by a few roundings of the differences of
    // coordinates, which are at most about 1.
    constexpr double slack = 0x1p-40;
    const double limit = std::sqrt(squared) + slack;
    return limit * limit;
}

void extend_by(Box& box, const Box& other) {
    const auto& [low, high] = other;
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y),
                std::max(box.high.z, high.z)};
}

double Point::*longest_axis(const Box& box) {
    const Point size = minus(box.high, box.low);
    if (size.x >= size.y && size.x >= size.z) return &Point::x;
    return size.y >= size.z ? &Point::y : &Point::z;
}

Slab::Slab(std::span<const Triangle> triangles) : origin_(triangles[0][0]) {
    Point sum{0, 0, 0};
    for (const auto& [a, b, c] : triangles) {
        const Point n = cross_of(minus(b, a), minus(c, a));
        const double sign = dot_of(n, sum) < 0 ? -1 : 1;  // the corners have no common order
        sum = {sum.x + sign * n.x, sum.y + sign * n.y, sum.z + sign * n.z};
    }
    // The square of a tiny sum may be rounded so much that the length is not near 1.
    const double square = dot_of(sum, sum);
    if (!(square > 0x1p-900)) return;
    const double length = std::sqrt(square);
    normal_ = {sum.x / length, sum.y / length, sum.z / length};
    for (const Triangle& triangle : triangles) {
        for (const Point& p : triangle) {
            const double height = dot_of(normal_, minus(p, origin_));
            low_ = std::min(low_, height);
            high_ = std::max(high_, height);
        }
    }
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles)
    : tree_(with_sorted_corners(std::move(triangles))) {}

Box TriangleTree::BoxOfTriangle::operator()(const Triangle& triangle) const {
    Box box{triangle[0], triangle[0]};
    for (const Point& p : triangle) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

double TriangleTree::least_squared_distance(const Point& p, double bound) const {
    double least = bound;
    double limit = limit_of_boxes(least);
    tree_.visit_near(p, limit, [&](const Triangle& triangle) {
        const double squared = squared_distance(p, triangle);
        if (!(squared < least)) return;
        least = squared;
        limit = limit_of_boxes(least);
    });
    return least;
}

}  // namespace octetra
