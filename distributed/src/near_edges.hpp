#pragma once

#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "chosen_cells.hpp"
#include "edge_stars.hpp"

namespace octetra::distributed {

/// Numbers the edges that one level may select. Most propagation paths end close to the chosen
/// cells, so that, if these are not most cells anyway, only the edges near them are numbered: those
/// of all cells at a vertex of a chosen cell's, of one within two edges of it, or of an interface.
/// A path that leads further is noticed at its first edge whose ends are both beyond, as then there
/// may be cells around it whose edges have no number; and widen() goes further, too.
///
/// Keeps a pointer to the mesh, which must stay as it is while edges are still selected. Memory,
/// beyond that of the stars: a byte per vertex, and twice that and 4 bytes per near cell meanwhile.
class NearEdges {
public:
    NearEdges(const DistributedMesh& mesh, const ChosenCells& chosen);

    /// Stays where it is, but numbers otherwise after widen().
    [[nodiscard]] const EdgeStars& stars() const { return stars_; }

    /// Have all cells around this edge of a cell's, by its place in cell_edges, edges of their own?
    [[nodiscard]] bool surround(CellIndex cell, std::size_t edge) const {
        if (is_near_.empty()) return true;
        const auto& [a, b] = cell_edges[edge];
        const CellVertices& vertices = mesh_->cells[cell];
        return (is_near_[vertices[a]] | is_near_[vertices[b]]) != 0;
    }

    /// Takes in vertices twice as far away; or all, if it comes to many.
    void widen();

private:
    void number_all();
    void add_ring();
    [[nodiscard]] std::vector<CellIndex> near_cells() const;

    const DistributedMesh* mesh_;
    IndexVector<VertexIndex, std::uint8_t> is_near_;  ///< empty if all are
    int rings_ = 0;                                   ///< of vertices around the first ones
    EdgeStars stars_;
};

}  // namespace octetra::distributed
