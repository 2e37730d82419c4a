#include "level/incremental/incremental_closure.hpp"

#include <algorithm>
#include <utility>

#include "pattern/length_order.hpp"

namespace octetra::distributed {

IncrementalClosure::IncrementalClosure(const DistributedMesh& mesh, Adjacency& adjacency,
                                       const TransitionCells* transition)
    : mesh_(&mesh),
      adjacency_(&adjacency),
      transition_(transition),
      outboxes_(mesh.interfaces.size()) {}

IncrementalClosure::~IncrementalClosure() {
    for (const Note& note : notes_) adjacency_->cell_to_note[note.cell] = CellIndex::none_value;
}

void IncrementalClosure::mark(CellIndex cell, EdgeMask edges) {
    const std::uint32_t note = note_of(cell);
    const auto missing = static_cast<EdgeMask>(edges & ~unsigned{notes_[note].marked});
    for (std::size_t e = 0; missing >> e != 0; ++e) {
        if ((missing >> e & 1U) == 0) continue;
        const auto [i, j] = cell_edges[e];
        const EdgeVertices edge{mesh_->cells[cell][i], mesh_->cells[cell][j]};
        set_mark(edge);
        notify_sharers(edge);
    }
}

// The sender notifies every sharer of the edge.
void IncrementalClosure::mark_from(std::size_t interface, std::uint32_t position) {
    const EdgeVertices& edge = mesh_->interfaces[interface].edges[position];
    if (!is_marked(edge)) set_mark(edge);
}

void IncrementalClosure::drain() {
    while (!queue_.empty()) {
        Note& queued = notes_[queue_.back()];
        queue_.pop_back();
        queued.queued = false;
        const Note note = queued;  // marking adds notes
        if (transition_ != nullptr && transition_->contains(note.cell)) {
            transition_->close(note.cell, note.marked,
                               [&](CellIndex cell, EdgeMask edges) { mark(cell, edges); });
        } else {
            mark(note.cell, table_->closure(note.order, note.marked));
        }
    }
}

std::uint32_t IncrementalClosure::note_of(CellIndex cell) {
    std::uint32_t& number = adjacency_->cell_to_note[cell];
    if (number == CellIndex::none_value) {
        notes_.push_back({.cell = cell, .order = length_order(mesh_->points, mesh_->cells[cell])});
        number = static_cast<std::uint32_t>(notes_.size() - 1);
    }
    return number;
}

bool IncrementalClosure::is_marked(const EdgeVertices& edge) const {
    bool marked = false;
    adjacency_->cells.for_each_with(edge, mesh_->cells, [&](CellIndex cell, std::size_t e) {
        const std::uint32_t note = adjacency_->cell_to_note[cell];
        if (note != CellIndex::none_value && (unsigned{notes_[note].marked} >> e & 1U) != 0) {
            marked = true;
        }
    });
    return marked;
}

void IncrementalClosure::set_mark(const EdgeVertices& edge) {
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    const EdgeIndex number = edges_.append({low, high});
    adjacency_->cells.for_each_with(edge, mesh_->cells, [&](CellIndex cell, std::size_t e) {
        const std::uint32_t n = note_of(cell);
        Note& note = notes_[n];
        note.edges[e] = number;
        note.marked = static_cast<EdgeMask>(note.marked | 1U << e);
        if (!note.queued) queue_.push_back(n);
        note.queued = true;
    });
}

void IncrementalClosure::notify_sharers(const EdgeVertices& edge) {
    adjacency_->shared_edges.for_each_with(edge, mesh_->interfaces, [&](const auto& found) {
        outboxes_[found.place.interface].push_back(found.place.position);
    });
}

std::vector<std::vector<std::uint32_t>> IncrementalClosure::take_outboxes() {
    return std::exchange(outboxes_, std::vector<std::vector<std::uint32_t>>(outboxes_.size()));
}

}  // namespace octetra::distributed
