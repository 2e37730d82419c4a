#include "cell_blocks.hpp"

#include <algorithm>
#include <limits>

namespace octetra::distributed {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void extend(Box& box, const Point& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

constexpr Box nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// The least (or greatest) mean of four numbers, none of which is less (greater): in the way of
/// centroid(), whose sums are rounded, but monotone.
double bound_of_means(double bound) { return (((bound + bound) + bound) + bound) / 4; }
Point bound_of_centroids(const Point& bound) {
    return {bound_of_means(bound.x), bound_of_means(bound.y), bound_of_means(bound.z)};
}

bool may_hold(const Sphere& sphere, const Box& centroids) {
    const Point& c = sphere.centre;
    const double dx = std::clamp(c.x, centroids.low.x, centroids.high.x) - c.x;
    const double dy = std::clamp(c.y, centroids.low.y, centroids.high.y) - c.y;
    const double dz = std::clamp(c.z, centroids.low.z, centroids.high.z) - c.z;
    return (dx * dx + dy * dy) + dz * dz < sphere.radius * sphere.radius;
}

bool may_hold(const Box& box, const Box& centroids) {
    const Point& low = centroids.low;
    const Point& high = centroids.high;
    return low.x <= box.high.x && box.low.x <= high.x && low.y <= box.high.y &&
           box.low.y <= high.y && low.z <= box.high.z && box.low.z <= high.z;
}

}  // namespace

bool may_be_chosen(const Selection& selection, const Box& corners) {
    // What chooses() computes of a centroid farther out, in the same way, is no smaller: rounding
    // is monotone.
    const Box centroids{bound_of_centroids(corners.low), bound_of_centroids(corners.high)};
    const auto may_hold_one = [&](const auto& body) { return may_hold(body, centroids); };
    return std::ranges::any_of(selection.spheres, may_hold_one) ||
           std::ranges::any_of(selection.boxes, may_hold_one);
}

Box box_of(const Corners& corners) {
    Box box = nothing;
    for (const Point& p : corners) extend(box, p);
    return box;
}

void CellBlocks::append(const DistributedMesh& mesh, CellIndex begin) {
    boxes_.resize((mesh.cells.size() + size - 1) / size, nothing);
    for (CellIndex c = begin; c < mesh.cells.end_index(); ++c) {
        for (const VertexIndex v : mesh.cells[c]) extend(boxes_[c.value() / size], mesh.points[v]);
    }
}

}  // namespace octetra::distributed
