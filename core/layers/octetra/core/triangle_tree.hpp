#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <octetra/core/point.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/core/shape.hpp>

/// Distances from points to triangles. All lengths are in units in which the differences of
/// coordinates are at most about 1, so that no product of them overflows.
namespace octetra {

/// Returns the squared distance to the closest point of a triangle, which may be flat. Its rounding
/// depends on the order of the corners.
[[nodiscard]] double squared_distance(const Point& p, const Triangle& triangle);

/// The squared distance to the closest and the farthest point of a box.
[[nodiscard]] double least_squared_distance(const Point& p, const Box& box);
[[nodiscard]] double greatest_squared_distance(const Point& p, const Box& box);

/// Returns the limit of squared distances to boxes beyond which no triangle in the box can be as
/// close as `squared`, whatever the rounding.
[[nodiscard]] double limit_of_boxes(double squared);

/// A tree of the bounding boxes of triangles.
class TriangleTree {
public:
    /// The corners of the triangles are sorted.
    explicit TriangleTree(std::vector<Triangle> triangles);

    [[nodiscard]] bool empty() const { return triangles_.empty(); }
    /// Returns up to `most` boxes, each with triangles, that contain all triangles.
    [[nodiscard]] std::vector<Box> boxes(std::size_t most) const;
    /// Returns the least squared distance to a triangle if it is less than `bound`, otherwise
    /// `bound`: exactly the least result of squared_distance(), whatever the tree.
    [[nodiscard]] double least_squared_distance(
        const Point& p, double bound = std::numeric_limits<double>::infinity()) const;

private:
    struct Node {
        Box box;
        std::uint32_t begin = 0;  ///< of its triangles
        std::uint32_t end = 0;
        std::uint32_t right =
            0;  ///< the second child, 0 for a leaf; the first one follows the node
    };

    void build(std::uint32_t begin, std::uint32_t end);

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace octetra
