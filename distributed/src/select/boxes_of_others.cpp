#include "select/boxes_of_others.hpp"

#include <algorithm>
#include <utility>

#include <octetra/core/cell_quantities.hpp>

namespace octetra::distributed {

int common_exponent(const DistributedMesh& mesh) {
    Box box = empty_box;
    for (const Point& p : mesh.points) extend(box, p);
    for (const auto& boxes : lists_of_all(mesh.processes, std::vector<Box>{box})) {
        if (boxes[0].low.x > boxes[0].high.x) continue;  // that process has no vertices
        extend(box, boxes[0].low);
        extend(box, boxes[0].high);
    }
    const auto& [low, high] = box;
    return exponent_of_extent(
        std::max({high.x / 2 - low.x / 2, high.y / 2 - low.y / 2, high.z / 2 - low.z / 2}));
}

BoxesOfOthers::BoxesOfOthers(std::vector<std::vector<Box>> boxes, int own_rank)
    : boxes_(std::move(boxes)) {
    boxes_[static_cast<std::size_t>(own_rank)].clear();
    for (const auto& of_rank : boxes_) {
        Box all = empty_box;
        for (const Box& box : of_rank) {
            extend(all, box.low);
            extend(all, box.high);
        }
        all_.push_back(all);
    }
}

double BoxesOfOthers::bound(const Point& p, double bound) const {
    for (std::size_t r = 0; r < boxes_.size(); ++r) {
        if (boxes_[r].empty() || least_squared_distance(p, all_[r]) > bound) continue;
        for (const Box& box : boxes_[r]) {
            bound = std::min(bound, greatest_squared_distance(p, box));
        }
    }
    return bound;
}

}  // namespace octetra::distributed
