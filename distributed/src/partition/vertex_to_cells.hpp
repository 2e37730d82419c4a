#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::distributed {

/// The cells at each vertex, ascending. Keeps a pointer to the mesh. Memory: 8 bytes per vertex and
/// 16 per cell.
class VertexToCells {
public:
    explicit VertexToCells(const Mesh& mesh)
        : mesh_(&mesh), begin_(mesh.points.size() + 1, 0), cells_(4 * mesh.cells.size()) {
        for (const CellVertices& cell : mesh.cells) {
            for (const VertexIndex v : cell) ++begin_[v.value()];
        }
        std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
        // Filled in reverse, which leaves each offset at the begin of its range.
        for (std::size_t c = mesh.cells.size(); c-- > 0;) {
            for (const VertexIndex v : mesh.cells[CellIndex{c}]) {
                cells_[--begin_[v.value()]] = CellIndex{c};
            }
        }
    }

    [[nodiscard]] std::span<const CellIndex> operator[](VertexIndex v) const {
        return {cells_.data() + begin_[v.value()], cells_.data() + begin_[v.value() + 1U]};
    }

    /// Calls found(c) for each cell c that has the edge. The search uses the end with fewer cells,
    /// as the other may be a hub with thousands.
    void cells_at(const EdgeVertices& edge, auto&& found) const {
        const bool first_has_fewer = (*this)[edge[0]].size() < (*this)[edge[1]].size();
        const auto [few, many] = first_has_fewer ? edge : EdgeVertices{edge[1], edge[0]};
        for (const CellIndex c : (*this)[few]) {
            if (std::ranges::count(mesh_->cells[c], many) != 0) found(c);
        }
    }

private:
    const Mesh* mesh_;
    std::vector<std::uint64_t> begin_;
    std::vector<CellIndex> cells_;
};

}  // namespace octetra::distributed
