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
                      const CarriedFields& fields, std::vector<std::uint8_t>& cell_to_mark) {
    Selection criteria = selection;
    criteria.cells.clear();
    const std::vector<std::uint8_t> marked =
        mesh.marked_cells(criteria, fields.all, fields.backgrounds);
    for (std::size_t c = 0; c < marked.size(); ++c) cell_to_mark[c] |= marked[c];
}

}  // namespace octetra::cli
