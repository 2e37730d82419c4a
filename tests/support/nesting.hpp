#pragma once

#include <algorithm>
#include <vector>

#include <octetra/reference/refine.hpp>

#include "support/refinement.hpp"

/// Exact tests of which cells contain which. Corners multiplied by `scale` must be integers of at
/// most 40 bits.
namespace octetra::test {

/// Returns whether the point lies in the cell or on its boundary.
inline bool contains(const Corners& cell, const Point& point, double scale) {
    for (std::size_t k = 0; k < 4; ++k) {
        Corners with_point = cell;
        with_point[k] = point;
        if (exact_volume(with_point, scale) < 0) return false;
    }
    return true;
}

inline bool contains(const Corners& cell, const Corners& other, double scale) {
    const auto is_outside_range = [&](double Point::*x) {
        const auto [low, high] = std::ranges::minmax(cell, {}, x);
        const auto [other_low, other_high] = std::ranges::minmax(other, {}, x);
        return other_low.*x < low.*x || other_high.*x > high.*x;
    };
    if (is_outside_range(&Point::x) || is_outside_range(&Point::y) || is_outside_range(&Point::z))
        return false;
    return std::ranges::all_of(other, [&](const Point& p) { return contains(cell, p, scale); });
}

/// For each cell of `fine`, the cells of `coarse` with the same root that contain it: both are
/// refinements of one mesh.
inline IndexVector<CellIndex, std::vector<CellIndex>> cells_around(
    const reference::Refinement& fine, const reference::Refinement& coarse, double scale) {
    std::vector<std::vector<CellIndex>> of_root;
    for (CellIndex c{0}; c < coarse.mesh.cells.end_index(); ++c) {
        const std::size_t root = coarse.maps.cell_to_parent[c].value();
        if (root >= of_root.size()) of_root.resize(root + 1);
        of_root[root].push_back(c);
    }
    IndexVector<CellIndex, std::vector<CellIndex>> around(fine.mesh.cells.size());
    for (CellIndex f{0}; f < fine.mesh.cells.end_index(); ++f) {
        const Corners corners = corners_of(fine.mesh, f);
        for (const CellIndex c : of_root[fine.maps.cell_to_parent[f].value()]) {
            if (contains(corners_of(coarse.mesh, c), corners, scale)) around[f].push_back(c);
        }
    }
    return around;
}

/// Returns whether each cell of `fine` lies in exactly one cell of `coarse`, and whether they fill
/// it.
inline bool refines(const reference::Refinement& fine, const reference::Refinement& coarse,
                    double scale) {
    const auto around = cells_around(fine, coarse, scale);
    IndexVector<CellIndex, Int128> filled(coarse.mesh.cells.size(), 0);
    for (CellIndex f{0}; f < fine.mesh.cells.end_index(); ++f) {
        if (around[f].size() != 1) return false;
        filled[around[f].front()] += exact_volume(corners_of(fine.mesh, f), scale);
    }
    for (CellIndex c{0}; c < coarse.mesh.cells.end_index(); ++c) {
        if (filled[c] != exact_volume(corners_of(coarse.mesh, c), scale)) return false;
    }
    return true;
}

/// For each cell of the last of these successive meshes, the cell whose bisection made it; itself
/// if there is none. Children replace their parent in the order of cells, and fill it.
inline std::vector<Corners> parents(const std::vector<reference::Refinement>& meshes,
                                    double scale) {
    std::vector<Corners> parent;
    for (CellIndex c{0}; c < meshes.front().mesh.cells.end_index(); ++c) {
        parent.push_back(corners_of(meshes.front().mesh, c));
    }
    for (std::size_t t = 1; t < meshes.size(); ++t) {
        const Mesh& coarse = meshes[t - 1].mesh;
        const Mesh& fine = meshes[t].mesh;
        std::vector<Corners> next;
        for (CellIndex c{0}, child{0}; c < coarse.cells.end_index(); ++c) {
            const bool stayed = coarse.cells[c] == fine.cells[child];
            Int128 left = exact_volume(corners_of(coarse, c), scale);
            for (; left > 0; ++child) {
                left -= exact_volume(corners_of(fine, child), scale);
                next.push_back(stayed ? parent[c.value()] : corners_of(coarse, c));
            }
        }
        parent = next;
    }
    return parent;
}

}  // namespace octetra::test
