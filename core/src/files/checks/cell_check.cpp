#include "files/checks/cell_check.hpp"

#include <span>
#include <utility>

#include <octetra/core/orientation.hpp>

namespace octetra {

void CellCheck::add_new_points() {
    filter_.add(std::span(mesh_->points).subspan(filter_.point_count()));
}

/// Returns the first cell from `from` on that the filter does not confirm as positive, or their
/// number.
std::size_t CellCheck::find_doubtful(std::span<const CellVertices> cells, std::size_t from) const {
    const PositiveFilter filter = filter_;
    const Point* const points = mesh_->points.data();
    for (std::size_t i = from; i < cells.size(); ++i) {
        const auto& [a, b, c, d] = cells[i];
        if (!filter.is_surely_positive(points[a.value()], points[b.value()], points[c.value()],
                                       points[d.value()])) {
            return i;
        }
    }
    return cells.size();
}

CellCheck::WrongCell CellCheck::check_entities(std::span<CellVertices> cells) {
    if (takes_all_) return {};
    if (filter_.point_count() < mesh_->points.size()) add_new_points();
    for (std::size_t i = find_doubtful(cells, 0); i < cells.size();
         i = find_doubtful(cells, i + 1)) {
        if (const std::string_view what = check_exactly(cells[i]); !what.empty()) return {i, what};
    }
    return {};
}

std::string_view CellCheck::check_exactly(CellVertices& cell) {
    for (const auto& [i, j] : cell_edges) {
        if (cell[i] == cell[j]) return "the cell has the same vertex twice";
    }
    const auto& points = mesh_->points;
    const int sign =
        orientation(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]);
    if (sign > 0) return {};
    if (sign == 0) {
        return "the cell is flat: its four corners lie in one plane; move one of them, or remove "
               "the cell";
    }
    if (!fix_orientation_) {
        return "the cell is inverted: exchange two of its corners, or read it with "
               "--fix-orientation";
    }
    std::swap(cell[2], cell[3]);
    ++fixed_count_;
    return {};
}

}  // namespace octetra
