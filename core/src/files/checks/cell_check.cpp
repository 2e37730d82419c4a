#include "files/checks/cell_check.hpp"

#include <span>
#include <utility>

#include <octetra/core/orientation.hpp>

namespace octetra {

void CellCheck::know_all_points() {
    filter_.add(std::span(mesh_->points).subspan(filter_.point_count()));
}

std::string_view CellCheck::judge_slowly(CellVertices& cell) {
    for (const auto& [i, j] : cell_edges) {
        if (cell[i] == cell[j]) return "the cell has the same vertex twice";
    }
    const auto& points = mesh_->points;
    const int sign =
        orientation(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]);
    if (sign > 0) return {};
    if (sign == 0) return "the cell is flat: its four corners lie in one plane";
    if (!fix_orientation_) {
        return "the cell is inverted: exchange two of its corners, or read it with "
               "--fix-orientation";
    }
    std::swap(cell[2], cell[3]);
    ++fixed_count_;
    return {};
}

}  // namespace octetra
