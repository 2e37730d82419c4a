#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The cells of a mesh before parts are distributed: each process has a contiguous share of them,
/// in the order of the mesh.
struct CellsToWeigh {
    Communicator processes;               ///< that have the cells
    std::uint64_t first_number = 0;       ///< number in the whole mesh of this process's first cell
    std::span<const CellVertices> cells;  ///< of this process; vertices are positions in `points`
    std::span<const Point> points;
    std::span<const Marker> regions;  ///< one for each cell, or empty

    /// The number of cells of this process.
    [[nodiscard]] std::size_t count() const { return cells.size(); }
    /// Returns the corners of cell number i of this process.
    [[nodiscard]] Corners corners(std::size_t i) const {
        const auto& [a, b, c, d] = cells[i];
        return {points[a.value()], points[b.value()], points[c.value()], points[d.value()]};
    }
};

/// Returns the cells of a mesh that this process holds completely. The result refers to the mesh.
[[nodiscard]] CellsToWeigh cells_to_weigh(const Mesh& mesh);

/// Collective among cells.processes. Predicts the number of cells that each cell becomes in
/// `levels` levels: the weights for a partition, which balance the result of refinement instead of
/// its input. Returns an empty vector on all processes if all cells become equally many, or if the
/// selection does not determine which become more. The numbers do not depend on the number of
/// processes.
///
/// A marked cell becomes 8, 4 or 2 cells in each level, by the scheme, and at most 1e9 in total.
/// For spheres and boxes the prediction is proportional to the fraction of the cell that is inside,
/// since closure refines that fraction even where it is not marked; a random fraction applies to
/// all cells alike. The cells that closure bisects around the marked cells are neglected, being few
/// in comparison.
[[nodiscard]] std::vector<float> predicted_cells(const CellsToWeigh& cells,
                                                 const Selection& selection, Scheme scheme,
                                                 int levels);

/// The same for a mesh that this process holds completely. Not collective.
[[nodiscard]] std::vector<float> predicted_cells(const Mesh& mesh, const Selection& selection,
                                                 Scheme scheme, int levels);

}  // namespace octetra::distributed
