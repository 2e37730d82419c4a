#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include <octetra/core/box_tree.hpp>
#include <octetra/core/point.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/core/shape.hpp>

/// Distances from points to triangles. All lengths are in units in which the differences of
/// coordinates are at most about 1, so that no product of them overflows.
namespace octetra {

/// Returns the squared distance to the closest point of a triangle, which may be flat. Its rounding
/// depends on the order of the corners.
[[nodiscard]] double squared_distance(const Point& p, const Triangle& triangle);

/// Returns the limit of squared distances to boxes and slabs beyond which no triangle in them can
/// be as close as `squared`, whatever the rounding.
[[nodiscard]] double limit_of_boxes(double squared);

/// Two parallel planes with triangles between them. Where a surface is smooth, they are much closer
/// to it than a box: this matters for points at nearly the same distance from many triangles.
class Slab {
public:
    /// The planes are normal to the mean of the normals.
    explicit Slab(std::span<const Triangle> triangles);

    [[nodiscard]] double least_squared_distance(const Point& p) const {
        const double height = normal_.x * (p.x - origin_.x) + normal_.y * (p.y - origin_.y) +
                              normal_.z * (p.z - origin_.z);
        const double gap = std::max({low_ - height, height - high_, 0.0});
        return gap * gap;
    }

private:
    Point origin_;
    Point normal_{0, 0, 0};  ///< of length 1, or 0 for triangles that are flat or tiny
    double low_ = 0;         ///< the heights of the planes over the origin
    double high_ = 0;
};

/// A tree of the bounding boxes and slabs of triangles.
class TriangleTree {
public:
    /// The corners of the triangles are sorted.
    explicit TriangleTree(std::vector<Triangle> triangles);

    [[nodiscard]] bool empty() const { return tree_.empty(); }
    /// Returns up to `most` boxes, each with triangles, that contain all triangles.
    [[nodiscard]] std::vector<Box> boxes(std::size_t most) const { return tree_.boxes(most); }
    /// Returns the least squared distance to a triangle if it is less than `bound`, otherwise
    /// `bound`: exactly the least result of squared_distance(), whatever the tree.
    [[nodiscard]] double least_squared_distance(
        const Point& p, double bound = std::numeric_limits<double>::infinity()) const;

private:
    struct BoxOfTriangle {
        Box operator()(const Triangle& triangle) const;
    };

    BoxTree<Triangle, BoxOfTriangle, Slab> tree_;
};

}  // namespace octetra
