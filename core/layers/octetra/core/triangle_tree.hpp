#pragma once

#include <limits>
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

/// Returns the limit of squared distances to boxes beyond which no triangle in the box can be as
/// close as `squared`, whatever the rounding.
[[nodiscard]] double limit_of_boxes(double squared);

/// A tree of the bounding boxes of triangles.
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

    BoxTree<Triangle, BoxOfTriangle> tree_;
};

}  // namespace octetra
