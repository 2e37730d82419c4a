#pragma once

#include <cstdint>
#include <vector>

#include "level/incremental/adjacency.hpp"
#include "level/incremental/incremental_closure.hpp"
#include "level/level.hpp"
#include "mark/marked_cells.hpp"

namespace octetra::distributed {

/// The way for few marked cells: takes time in proportion to the cells that are bisected and those
/// around them, once the mesh has its Adjacency; leaves the mesh unordered.
class IncrementalLevel final : public Level {
public:
    explicit IncrementalLevel(DistributedMesh& mesh);

    /// Marks edges of the marked cells.
    void mark(const MarkedCells& marked, Scheme scheme);

    [[nodiscard]] Closure& closure() override { return closure_; }
    void bisect_edges() override;
    [[nodiscard]] std::size_t cell_count_afterwards() override;
    [[nodiscard]] RoundingFailure bisect_cells(std::size_t cell_count) override;
    void bisect_tagged() override;
    void bisect_interfaces() override;
    [[nodiscard]] std::size_t cells_touched() const override { return closure_.notes().size(); }

private:
    struct BadChild {
        CellIndex cell;
        std::uint32_t root = 0;
        int sign = 0;
    };

    [[nodiscard]] const Pattern& pattern_of(const IncrementalClosure::Note& note) const;
    [[nodiscard]] MidpointMarker marker_of(const EdgeVertices& edge) const;
    void bisect(const IncrementalClosure::Note& note, std::vector<BadChild>& bad);
    [[nodiscard]] RoundingFailure first_of(std::vector<BadChild> bad) const;
    void bisect_shared_edges();
    void bisect_shared_faces();

    DistributedMesh* mesh_;
    Adjacency* adjacency_;
    IncrementalClosure closure_;
    IndexVector<EdgeIndex, VertexIndex> midpoints_;  ///< of each marked edge
};

}  // namespace octetra::distributed
