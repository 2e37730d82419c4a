#include <octetra/core/triangle_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace octetra {
namespace {

constexpr std::uint32_t leaf_size = 8;

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

Box box_of_triangle(const Triangle& triangle) {
    Box box{triangle[0], triangle[0]};
    for (const Point& p : triangle) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

void extend_by(Box& box, const Box& other) {
    const auto& [low, high] = other;
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y),
                std::max(box.high.z, high.z)};
}

/// The coordinate in which a box is longest.
double Point::*longest_axis(const Box& box) {
    const Point size = minus(box.high, box.low);
    if (size.x >= size.y && size.x >= size.z) return &Point::x;
    return size.y >= size.z ? &Point::y : &Point::z;
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

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
    for (Triangle& triangle : triangles_) std::ranges::sort(triangle);
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

// The depth is the logarithm of the number of triangles, as halves are equally large.
void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({box_of_triangle(triangles_[begin]), begin, end, 0});
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        extend_by(nodes_[node].box, box_of_triangle(triangles_[i]));
    }
    if (end - begin <= leaf_size) return;
    double Point::*const axis = longest_axis(nodes_[node].box);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto sum = [axis](const Triangle& t) {
        return t[0].*axis / 3 + t[1].*axis / 3 + t[2].*axis / 3;
    };
    std::ranges::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                             triangles_.begin() + end, {}, sum);
    build(begin, middle);
    nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end);
}

std::vector<Box> TriangleTree::boxes(std::size_t most) const {
    if (nodes_.empty()) return {};
    std::vector<std::uint32_t> front{0};
    for (bool is_divided = true; is_divided && 2 * front.size() <= most;) {
        is_divided = false;
        std::vector<std::uint32_t> next;
        for (const std::uint32_t node : front) {
            if (nodes_[node].right == 0) {
                next.push_back(node);
                continue;
            }
            next.push_back(node + 1);
            next.push_back(nodes_[node].right);
            is_divided = true;
        }
        front = std::move(next);
    }
    std::vector<Box> boxes;
    for (const std::uint32_t node : front) boxes.push_back(nodes_[node].box);
    return boxes;
}

double TriangleTree::least_squared_distance(const Point& p, double bound) const {
    if (nodes_.empty()) return bound;
    double least = bound;
    double limit = limit_of_boxes(least);
    struct Waiting {
        std::uint32_t node;
        double squared;
    };
    std::array<Waiting, 80> stack{};  // two for each level of the tree
    std::size_t size = 0;
    stack[size++] = {0, octetra::least_squared_distance(p, nodes_[0].box)};
    while (size > 0) {
        const auto [number, squared] = stack[--size];
        if (squared > limit) continue;
        const Node& node = nodes_[number];
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                least = std::min(least, squared_distance(p, triangles_[i]));
            }
            limit = limit_of_boxes(least);
            continue;
        }
        Waiting near{number + 1, octetra::least_squared_distance(p, nodes_[number + 1].box)};
        Waiting far{node.right, octetra::least_squared_distance(p, nodes_[node.right].box)};
        if (far.squared < near.squared) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    return least;
}

}  // namespace octetra
