#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "level/incremental/adjacency.hpp"
#include "level/incremental/incremental_closure.hpp"
#include "level/level.hpp"
#include "level/marked_cells.hpp"
#include "level/midpoints.hpp"

namespace octetra::distributed {

/// Level for few marked cells: takes time proportional to the bisected cells and those around them,
/// once the mesh has its Adjacency, and leaves the mesh unordered.
class IncrementalLevel final : public Level {
public:
    /// `transition` may be null: there are no such cells.
    explicit IncrementalLevel(DistributedMesh& mesh, const TransitionCells* transition = nullptr);
    ~IncrementalLevel() override;
    IncrementalLevel(const IncrementalLevel&) = delete;
    IncrementalLevel& operator=(const IncrementalLevel&) = delete;
    IncrementalLevel(IncrementalLevel&&) = delete;
    IncrementalLevel& operator=(IncrementalLevel&&) = delete;

    /// Marks edges of the marked cells.
    void mark(const MarkedCells& marked, Scheme scheme);

    [[nodiscard]] MarkedEdges& closure() override { return closure_; }
    [[nodiscard]] MarkedCells closed_marks() override;
    void bisect_edges() override;
    [[nodiscard]] std::size_t cell_count_afterwards() override;
    [[nodiscard]] RoundingFailure bisect_cells(std::size_t cell_count) override;
    void bisect_tagged() override;
    void bisect_interfaces() override;
    [[nodiscard]] std::vector<std::vector<VertexIndex>> shared_midpoints() const override;
    [[nodiscard]] ListChanges changes() override;
    void commit() noexcept override;
    [[nodiscard]] std::unique_ptr<MadeChange> commit_reversibly() override;
    [[nodiscard]] std::size_t cells_touched() const override { return closure_.notes().size(); }

private:
    class MadeLevel;
    /// A cell with a child that is flat or inverted.
    struct BadParent {
        CellIndex cell;
        std::uint32_t root = 0;
        int sign = 0;  ///< of the first such child
    };
    /// A triangle, identified by a key, with the midpoints of its bisected edges.
    template <class Key>
    struct CutTriangle {
        Key key;
        std::array<VertexIndex, 3> midpoints{};
    };
    struct CutEdge {
        EdgeIndex edge;
        VertexIndex midpoint;
    };
    struct SharedFace {
        SharedPosition place;
        SharedIndex index;

        friend auto operator<=>(const SharedFace&, const SharedFace&) = default;
    };
    struct CutSharedEdge {
        SharedPosition place;
        SharedIndex index;
        VertexIndex midpoint;
    };

    [[nodiscard]] const Pattern& pattern_of(const IncrementalClosure::Note& note) const;
    [[nodiscard]] MidpointMarker marker_of(const EdgeVertices& edge) const;
    [[nodiscard]] std::array<CellVertices, 8> children_of(
        const IncrementalClosure::Note& note) const;
    [[nodiscard]] int sign_of_first_bad_child(const IncrementalClosure::Note& note) const;
    [[nodiscard]] RoundingFailure first_of(std::vector<BadParent> bad) const;
    void find_shared_cuts();
    void make_room_in_interfaces();
    void change_lists() noexcept;
    void commit_cells();
    void commit_tagged();
    void commit_shared_edges();
    void commit_shared_faces();

    DistributedMesh* mesh_;
    Adjacency* adjacency_;
    IncrementalClosure closure_;
    IndexVector<EdgeIndex, VertexIndex> midpoints_;  ///< of each marked edge
    std::unique_ptr<AppendedMidpoints> appended_;    ///< once the midpoints are appended

    // The changes that commit() makes. Each list is ascending by the bisected entities.
    std::vector<CellIndex> new_cells_;
    std::vector<CutTriangle<FacetIndex>> cut_facets_;
    std::vector<CutEdge> cut_tagged_edges_;
    std::vector<CutSharedEdge> cut_shared_edges_;
    std::vector<CutTriangle<SharedFace>> cut_shared_faces_;
};

}  // namespace octetra::distributed
