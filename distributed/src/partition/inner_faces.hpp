#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// Calls found(face, a, b) once for every face that two cells share, a < b, in a Mesh or a
/// process's part of one; the face's vertices are ascending. If more than two cells have the same
/// face, which is invalid, they are reported in pairs.
///
/// Each face is processed at its lowest vertex: a cell has three faces at its lowest vertex, and
/// one at its second lowest. So each cell is accessed twice, whatever the order of cells. Memory: 4
/// bytes per vertex and 8 per cell.
void for_each_inner_face(const auto& mesh, auto&& found) {
    const auto sorted = [](CellVertices cell) {
        for (const auto& [i, j] : {std::pair{0U, 1U}, {2U, 3U}, {0U, 2U}, {1U, 3U}, {1U, 2U}}) {
            if (cell[j] < cell[i]) std::swap(cell[i], cell[j]);
        }
        return cell;
    };
    std::vector<std::uint64_t> begin(mesh.points.size() + 1, 0);
    for (const CellVertices& cell : mesh.cells) {
        const CellVertices corners = sorted(cell);
        ++begin[corners[0].value()];
        ++begin[corners[1].value()];
    }
    std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
    // Filled in reverse, which leaves each offset at the begin of its range.
    std::vector<CellIndex> cells(2 * mesh.cells.size());
    for (std::size_t c = mesh.cells.size(); c-- > 0;) {
        const CellVertices corners = sorted(mesh.cells[CellIndex{c}]);
        cells[--begin[corners[0].value()]] = CellIndex{c};
        cells[--begin[corners[1].value()]] = CellIndex{c};
    }

    struct Face {
        VertexIndex middle;
        VertexIndex high;
        CellIndex cell;
        auto operator<=>(const Face&) const = default;
    };
    std::vector<Face> faces;  // with the current lowest vertex
    for (VertexIndex low{0}; low < mesh.points.end_index(); ++low) {
        faces.clear();
        for (auto k = begin[low.value()]; k < begin[low.value() + 1U]; ++k) {
            const CellVertices v = sorted(mesh.cells[cells[k]]);
            faces.push_back({v[2], v[3], cells[k]});
            if (v[0] == low) {
                faces.back() = {v[1], v[2], cells[k]};
                faces.push_back({v[1], v[3], cells[k]});
                faces.push_back({v[2], v[3], cells[k]});
            }
        }
        std::sort(faces.begin(), faces.end());
        for (std::size_t f = 1; f < faces.size(); ++f) {
            const Face& a = faces[f - 1];
            const Face& b = faces[f];
            if (a.middle != b.middle || a.high != b.high) continue;
            found(FacetVertices{low, a.middle, a.high}, a.cell, b.cell);
            ++f;  // neither belongs to another pair
        }
    }
}

}  // namespace octetra::distributed
