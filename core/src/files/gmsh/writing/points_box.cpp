#include "files/gmsh/writing/points_box.hpp"

#include <algorithm>
#include <limits>

#include "files/output/text_slices.hpp"
#include "files/shares/gather.hpp"

namespace octetra::gmsh {
namespace {

void include(PointsBox& box, const Point& low, const Point& high) {
    for (double Point::*const c : {&Point::x, &Point::y, &Point::z}) {
        box.low.*c = std::min(box.low.*c, low.*c);
        box.high.*c = std::max(box.high.*c, high.*c);
    }
}

Point with_positive_zeros(const Point& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

}  // namespace

PointsBox box_of_points(MeshSource& mesh) {
    const std::uint64_t count = mesh.facts().vertices;
    const ProcessGroup& group = mesh.group();
    if (count == 0) return {};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PointsBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    const std::uint64_t length = lines_of_a_turn(count, group);
    const std::uint64_t stride = length * static_cast<std::uint64_t>(group.size());
    for (Window window{0, length, count}; window.begin < count; window.begin += stride) {
        for (const Point& p : mesh.points(window)) include(box, p, p);
    }
    for (const PointsBox& other : gather(group, box)) include(box, other.low, other.high);
    return {with_positive_zeros(box.low), with_positive_zeros(box.high)};
}

}  // namespace octetra::gmsh
