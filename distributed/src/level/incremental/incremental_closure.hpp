#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "level/incremental/adjacency.hpp"
#include "level/marked_edges.hpp"
#include "level/transition_cells.hpp"
#include "pattern/patterns.hpp"

namespace octetra::distributed {

/// Closure that numbers marked edges only. Marking an edge updates the notes of all cells with the
/// edge, which are found at its ends; so the note of a cell is always complete.
class IncrementalClosure final : public MarkedEdges {
public:
    /// The state of a cell that the closure has processed.
    struct Note {
        CellIndex cell;
        LengthOrder order = 0;
        EdgeMask marked = 0;
        bool queued = false;
        std::array<EdgeIndex, 6> edges{};  ///< numbers of the marked ones, none() for others
    };

    /// Keeps references to all arguments. `transition` may be null: there are no such cells.
    IncrementalClosure(const DistributedMesh& mesh, Adjacency& adjacency,
                       const TransitionCells* transition);
    ~IncrementalClosure() override;
    IncrementalClosure(const IncrementalClosure&) = delete;
    IncrementalClosure& operator=(const IncrementalClosure&) = delete;
    IncrementalClosure(IncrementalClosure&&) = delete;
    IncrementalClosure& operator=(IncrementalClosure&&) = delete;

    /// Marks a set of edges of a cell without following their paths. Their sharers will be
    /// notified.
    void mark(CellIndex cell, EdgeMask edges);
    [[nodiscard]] LengthOrder order_of(CellIndex cell) { return notes_[note_of(cell)].order; }

    void mark_from(std::size_t interface, std::uint32_t position) override;
    void drain() override;
    [[nodiscard]] std::size_t marked_count() const override { return edges_.size(); }
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> take_outboxes() override;

    /// The ends of the marked edges, lower first, in the order of marking.
    [[nodiscard]] const IndexVector<EdgeIndex, EdgeVertices>& edges() const { return edges_; }
    [[nodiscard]] const std::vector<Note>& notes() const { return notes_; }

private:
    std::uint32_t note_of(CellIndex cell);
    [[nodiscard]] bool is_marked(const EdgeVertices& edge) const;
    void set_mark(const EdgeVertices& edge);
    void notify_sharers(const EdgeVertices& edge);

    const DistributedMesh* mesh_;
    Adjacency* adjacency_;
    const TransitionCells* transition_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<EdgeIndex, EdgeVertices> edges_;
    std::vector<Note> notes_;
    std::vector<std::uint32_t> queue_;  // indices of notes
    std::vector<std::vector<std::uint32_t>> outboxes_;
};

}  // namespace octetra::distributed
