#include "adapt/marked_cells.hpp"

#include <algorithm>
#include <cstddef>

#include "adapt/cell_numbers.hpp"

namespace octetra::cli {

std::vector<std::uint8_t> listed_cells(const distributed::AdaptiveMesh& mesh,
                                       const std::vector<GlobalCell>& cells) {
    std::vector<std::uint8_t> cell_to_mark;
    cell_to_mark.reserve(mesh.cells().size());
    for (const std::uint64_t number : cell_numbers(mesh)) {
        cell_to_mark.push_back(std::ranges::binary_search(cells, GlobalCell{number}) ? 1 : 0);
    }
    return cell_to_mark;
}

void add_marked_cells(const distributed::AdaptiveMesh& mesh, const Selection& selection,
                      std::vector<std::uint8_t>& cell_to_mark) {
    Selection criteria = selection;
    criteria.cells.clear();
    const std::vector<Marker> regions =
        criteria.regions.empty() ? std::vector<Marker>{} : mesh.regions();
    const auto points = mesh.points();
    const auto cells = mesh.cells();
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = points[cells[c][k].value()];
        const Marker region = regions.empty() ? Marker{0} : regions[c];
        if (marks(criteria, corners, region, GlobalCell{0})) cell_to_mark[c] = 1;
    }
}

}  // namespace octetra::cli
