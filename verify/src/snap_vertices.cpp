#include "snap_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lookup/box_tree.hpp"

namespace octetra::verify {
namespace {

BoxTree tree_of(const Mesh& mesh) {
    std::vector<Bounds> boxes;
    boxes.reserve(mesh.points.size());
    for (const Point& p : mesh.points) boxes.push_back(bounds_of(std::array{p}));
    return BoxTree(std::move(boxes));
}

/// The cube around a point whose sides have this distance from it.
Bounds around(const Point& p, double distance) {
    return {{p.x - distance, p.y - distance, p.z - distance},
            {p.x + distance, p.y + distance, p.z + distance}};
}

double distance(const Point& a, const Point& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

double snap_vertices(Mesh& mesh, const Mesh& target, double tolerance) {
    const BoxTree tree = tree_of(target);
    double greatest = 0;
    for (Point& p : mesh.points) {
        std::pair<double, Point> nearest{tolerance, p};
        bool is_found = false;
        tree.for_each_meeting(around(p, tolerance), [&](std::uint32_t i) {
            const Point& candidate = target.points[VertexIndex{i}];
            const std::pair<double, Point> found{distance(p, candidate), candidate};
            if (found.first > tolerance || (is_found && !(found < nearest))) return;
            nearest = found;
            is_found = true;
        });
        if (!is_found) continue;
        p = nearest.second;
        greatest = std::max(greatest, nearest.first);
    }
    return greatest;
}

}  // namespace octetra::verify
