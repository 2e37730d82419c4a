#include "properties/coarser_meshes.hpp"

#include <algorithm>
#include <functional>

#include "support/nesting.hpp"

namespace octetra::properties {

using reference::CellMarks;
using reference::Refinement;

bool has_unmarked_cells(const Mesh& old, const CellMarks& marked, const Mesh& coarser) {
    const auto cells = test::geometry(coarser);
    for (CellIndex c{0}; c < old.cells.end_index(); ++c) {
        if (marked[c] != 0) continue;
        Corners corners = test::corners_of(old, c);
        std::ranges::sort(corners, std::less<>{});
        const Marker region = old.regions.empty() ? 0 : old.regions[c];
        if (!std::ranges::binary_search(cells, std::pair(corners, region), std::less<>{})) {
            return false;
        }
    }
    return true;
}

bool coarsens_by_one_generation(const std::vector<Refinement>& before, const Refinement& coarser,
                                double scale) {
    const auto parents = test::parents(before, scale);
    const auto around = test::cells_around(before.back(), coarser, scale);
    for (CellIndex c{0}; c < around.end_index(); ++c) {
        for (const CellIndex larger : around[c]) {
            const Corners corners = test::corners_of(coarser.mesh, larger);
            if (!test::contains(parents[c.value()], corners, scale)) return false;
        }
    }
    return true;
}

}  // namespace octetra::properties
