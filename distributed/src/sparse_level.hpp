#pragma once

#include <cstdint>
#include <vector>

#include "adjacency.hpp"
#include "chosen_cells.hpp"
#include "level.hpp"
#include "sparse_closure.hpp"

namespace octetra::distributed {

/// The way for few chosen cells: takes time in proportion to the cells that are bisected and those
/// around them, once the mesh has its Adjacency; leaves the mesh loose.
class SparseLevel final : public Level {
public:
    explicit SparseLevel(DistributedMesh& mesh);

    /// Selects edges of the chosen cells.
    void select(const ChosenCells& chosen, Scheme scheme);

    [[nodiscard]] Closure& closure() override { return closure_; }
    void bisect_edges() override;
    [[nodiscard]] std::size_t cell_count_afterwards() override;
    [[nodiscard]] RoundingFailure bisect_cells(std::size_t cell_count) override;
    void bisect_listed() override;
    void bisect_interfaces() override;
    [[nodiscard]] std::size_t cells_touched() const override { return closure_.notes().size(); }

private:
    struct BadChild {
        CellIndex cell;
        std::uint32_t root = 0;
        int sign = 0;
    };

    [[nodiscard]] const Pattern& pattern_of(const SparseClosure::Note& note) const;
    [[nodiscard]] MidpointMarker marker_of(const EdgeVertices& edge) const;
    void bisect(const SparseClosure::Note& note, std::vector<BadChild>& bad);
    [[nodiscard]] RoundingFailure first_of(std::vector<BadChild> bad) const;
    void bisect_shared_edges();
    void bisect_shared_faces();

    DistributedMesh* mesh_;
    Adjacency* adjacency_;
    SparseClosure closure_;
    IndexVector<EdgeIndex, VertexIndex> midpoints_;  ///< of each selected edge
};

}  // namespace octetra::distributed
