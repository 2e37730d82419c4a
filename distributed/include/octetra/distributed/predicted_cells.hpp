#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Cells of a mesh before processes get their parts: each process has a stretch of them, in the
/// order of the mesh.
struct CellsToWeigh {
    Communicator processes;
    std::uint64_t first_number = 0;       ///< of the whole mesh's cells
    std::span<const CellVertices> cells;  ///< of this process, by place in `points`
    std::span<const Point> points;
    std::span<const Marker> regions;  ///< or empty

    [[nodiscard]] std::size_t count() const { return cells.size(); }
    [[nodiscard]] Corners corners(std::size_t i) const {
        const auto& [a, b, c, d] = cells[i];
        return {points[a.value()], points[b.value()], points[c.value()], points[d.value()]};
    }
};

/// The cells of a mesh that this process has all of.
[[nodiscard]] CellsToWeigh cells_to_weigh(const Mesh& mesh);

/// Collective among the processes that have the cells. About how many cells each cell becomes in so
/// many levels: what parts are to be even in, so that the process that has the refined place does
/// not get nearly all of the result. Empty, on all processes, where all become equally many, or
/// nothing tells which become more. The numbers do not depend on how many processes there are.
///
/// A marked cell becomes 8, 4 or 2 in each level, by the scheme, and 1e9 at most. Of a sphere or
/// box it counts how much of a cell is inside, as closure leads there what is not marked itself; a
/// random share is as large everywhere. What closure does around the marked cells is left out: it
/// is little beside them.
[[nodiscard]] std::vector<float> predicted_cells(const CellsToWeigh& cells,
                                                 const Selection& selection, Scheme scheme,
                                                 int levels);

/// The same of a mesh that this process has all of. Not collective.
[[nodiscard]] std::vector<float> predicted_cells(const Mesh& mesh, const Selection& selection,
                                                 Scheme scheme, int levels);

}  // namespace octetra::distributed
