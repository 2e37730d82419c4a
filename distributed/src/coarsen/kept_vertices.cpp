#include "coarsen/kept_vertices.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <octetra/core/edge_order.hpp>

#include "coarsen/level_removals.hpp"
#include "history/families.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

/// Stores the marks of cells in the notes of the Adjacency during its lifetime.
class CellMarks {
public:
    CellMarks(const MarkedCells& marked, Adjacency& adjacency)
        : marked_(&marked), notes_(&adjacency.cell_to_note) {
        for (const CellIndex c : marked.cells) (*notes_)[c] = 0;
    }
    ~CellMarks() {
        for (const CellIndex c : marked_->cells) (*notes_)[c] = CellIndex::none_value;
    }
    CellMarks(const CellMarks&) = delete;
    CellMarks& operator=(const CellMarks&) = delete;
    CellMarks(CellMarks&&) = delete;
    CellMarks& operator=(CellMarks&&) = delete;

    [[nodiscard]] bool has(CellIndex c) const { return (*notes_)[c] != CellIndex::none_value; }

private:
    const MarkedCells* marked_;
    IndexVector<CellIndex, std::uint32_t>* notes_;
};

class KeptVertexSearch {
public:
    KeptVertexSearch(const DistributedMesh& mesh, const MarkedCells& marked, Adjacency* adjacency)
        : mesh_(&mesh), levels_(mesh), marked_(&marked), was_divided_(levels_.count() + 1, false) {
        if (adjacency == nullptr) {
            kept_.assign(mesh.points.size(), 0);
            std::fill_n(kept_.begin(), mesh.input_vertices.size(), std::uint8_t{1});
            keep_required_vertices();
        } else {
            kept_.assign(mesh.points.size(), 1);
            find_removable_vertices(*adjacency);
        }
    }

    void keep(VertexIndex v) { kept_[v] = 1; }
    [[nodiscard]] bool has(VertexIndex v) const { return kept_[v] != 0; }
    [[nodiscard]] KeptVertices result() && { return std::move(kept_); }

    /// Applies rule (b) on this process until nothing changes.
    void close() {
        if (is_another_level_divided()) list_open_cells();
        for (bool changed = true; changed;) {
            changed = false;
            std::erase_if(open_cells_,
                          [&](CellIndex c) { return close(mesh_->cells[c], changed); });
            std::ranges::reverse(open_cells_);  // marks may affect earlier cells
        }
    }

    /// Applies rule (c) once to all cells of this process; the mesh must be in canonical order.
    /// Returns whether anything changed.
    bool complete_families() {
        struct Note {
            bool has_kept_midpoint = false;
        };
        using CellFamilies = Families<4, Note>;
        bool changed = false;
        CellFamilies families(levels_);
        const auto on_parent = [&](std::uint32_t level, const CellVertices&,
                                   std::span<const CellFamilies::Member> members) {
            const bool keeps_all = std::ranges::any_of(
                members, [](const auto& member) { return member.note.has_kept_midpoint; });
            Note parent;
            for (const CellFamilies::Member& member : members) {
                for (const VertexIndex v : member.vertices) {
                    if (v < levels_.begin(level)) continue;
                    changed = changed || (keeps_all && !has(v));
                    if (keeps_all) keep(v);
                    parent.has_kept_midpoint = parent.has_kept_midpoint || has(v);
                }
            }
            return parent;
        };
        for (const CellVertices& cell : mesh_->cells) {
            families.add(cell, {}, on_parent, [](auto&&...) {});
        }
        return changed;
    }

private:
    /// Returns whether there is a level, not divided at the previous call, of which some midpoints
    /// are kept and some may be removed. Rule (b) affects only such levels.
    [[nodiscard]] bool is_another_level_divided() {
        bool found = false;
        const LevelRemovals removals(levels_, kept_);
        for (std::uint32_t level = 1; level <= levels_.count(); ++level) {
            if (was_divided_[level] || !removals.is_divided(level)) continue;
            was_divided_[level] = true;
            found = true;
        }
        return found;
    }
    /// Lists the marked cells of divided levels with a vertex that may be removed. Their number
    /// decreases, as vertices can only change to kept.
    void list_open_cells() {
        open_cells_.clear();
        std::uint32_t level = levels_.count();
        const auto list = [&](CellIndex c) {
            const CellVertices& cell = mesh_->cells[c];
            level = levels_.newest(cell, level);
            if (was_divided_[level] && !has_all(cell)) open_cells_.push_back(c);
        };
        if (marked_->all) {
            for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) list(c);
        } else {
            std::ranges::for_each(marked_->cells, list);
        }
    }
    [[nodiscard]] bool has_all(const CellVertices& cell) const {
        return std::ranges::all_of(cell, [&](VertexIndex v) { return has(v); });
    }

    /// Applies rule (a) by testing all cells.
    void keep_required_vertices() {
        if (marked_->all) {
            keep_older_vertices();
            return;
        }
        auto next_marked = marked_->cells.begin();
        std::uint32_t level = levels_.count();
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            const CellVertices& cell = mesh_->cells[c];
            const bool is_marked = next_marked != marked_->cells.end() && *next_marked == c;
            if (is_marked) {
                ++next_marked;
                level = levels_.newest(cell, level);
            }
            keep_before(is_marked ? levels_.begin(level) : VertexIndex::none(), cell);
        }
    }
    void keep_older_vertices() {
        std::uint32_t level = levels_.count();
        for (const CellVertices& cell : mesh_->cells) {
            level = levels_.newest(cell, level);
            keep_before(levels_.begin(level), cell);
        }
    }
    /// Without a branch, which would be mispredicted: vertex 0 belongs to the input, and is kept
    /// anyway.
    void keep_before(VertexIndex first_new, const CellVertices& cell) {
        for (const VertexIndex v : cell) kept_[v < first_new ? v : VertexIndex{0}] = 1;
    }

    /// Applies rule (a) by testing the cells at the new vertices of marked cells.
    void find_removable_vertices(Adjacency& adjacency) {
        const CellMarks is_marked(*marked_, adjacency);
        std::vector<bool> is_judged(mesh_->points.size(), false);
        for (const CellIndex c : marked_->cells) {
            const CellVertices& cell = mesh_->cells[c];
            const std::uint32_t level = levels_.newest(cell);
            if (level == 0) continue;
            for (const VertexIndex v : cell) {
                if (v < levels_.begin(level) || is_judged[v.value()]) continue;
                is_judged[v.value()] = true;
                bool is_removable = true;
                adjacency.cells.for_each_at(v, [&](CellIndex at) {
                    is_removable = is_removable && is_marked.has(at) &&
                                   levels_.newest(mesh_->cells[at]) == level;
                });
                kept_[v] = is_removable ? 0 : 1;
            }
        }
    }

    /// Applies rule (b) to one cell, whose vertices before the first new one are also vertices of
    /// its parent. Returns whether all of its vertices are kept.
    bool close(const CellVertices& cell, bool& changed) {
        const VertexIndex first_new = levels_.begin(levels_.newest(cell));
        unsigned kept = 0;
        unsigned kept_new = 0;
        for (const VertexIndex v : cell) {
            kept += kept_[v];
            kept_new += v < first_new ? 0U : kept_[v];
        }
        if (kept == cell.size() || kept_new == 0) return kept == cell.size();
        for (const VertexIndex v : cell) {
            if (has(v)) continue;
            for (const VertexIndex other : cell) {
                if (other < first_new || !has(other) || !is_longest_of_face(v, other)) continue;
                keep(v);
                ++kept;
                changed = true;
                break;
            }
        }
        return kept == cell.size();
    }
    /// Returns whether two midpoints of one level that an edge of the mesh joins lie in a face
    /// whose longest edge is that of the first.
    [[nodiscard]] bool is_longest_of_face(VertexIndex v, VertexIndex other) const {
        const EdgeVertices& a = levels_.ends(v);
        const EdgeVertices& b = levels_.ends(other);
        const bool meet = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
        return meet && longer(segment(a), segment(b));
    }
    [[nodiscard]] Segment segment(const EdgeVertices& ends) const {
        return {mesh_->points[ends[0]], mesh_->points[ends[1]]};
    }

    const DistributedMesh* mesh_;
    VertexLevels levels_;
    const MarkedCells* marked_;
    KeptVertices kept_;
    std::vector<bool> was_divided_;      ///< by level, at the last call of close()
    std::vector<CellIndex> open_cells_;  ///< of divided levels, with a vertex that may be removed
};

using Outboxes = std::vector<std::vector<std::uint32_t>>;

/// The state of the exchange of shared vertices with neighbours, in terms of positions in lists
/// that both ranks have.
class KeptVertexExchange {
public:
    explicit KeptVertexExchange(const Sharing<VertexIndex>& sharing) : sharing_(&sharing) {
        for (const auto& with : sharing.neighbours()) {
            ranks_.push_back(with.rank);
            is_removable_.emplace_back(with.entities.size(), false);
        }
    }
    [[nodiscard]] const std::vector<int>& ranks() const { return ranks_; }

    /// Returns the vertices that may be removed as far as this process knows.
    [[nodiscard]] Outboxes first(const KeptVertexSearch& search) {
        return outboxes([&](std::size_t i, std::size_t k, VertexIndex v) {
            is_removable_[i][k] = !search.has(v);
            return is_removable_[i][k];
        });
    }
    void apply_initial(const Outboxes& inboxes, KeptVertexSearch& search) {
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            const auto& vertices = sharing_->neighbours()[i].entities;
            auto next = inboxes[i].begin();
            for (std::size_t k = 0; k < vertices.size(); ++k) {
                if (next != inboxes[i].end() && *next == k) {
                    ++next;
                    continue;
                }
                search.keep(vertices[k]);
                is_removable_[i][k] = false;  // the other rank knows it
            }
        }
    }
    /// Returns the kept vertices that the other rank does not know to be kept.
    [[nodiscard]] Outboxes pending(const KeptVertexSearch& search) {
        return outboxes([&](std::size_t i, std::size_t k, VertexIndex v) {
            const bool is_pending = is_removable_[i][k] && search.has(v);
            if (is_pending) is_removable_[i][k] = false;
            return is_pending;
        });
    }
    void apply(const Outboxes& inboxes, KeptVertexSearch& search) {
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            for (const std::uint32_t k : inboxes[i]) {
                search.keep(sharing_->neighbours()[i].entities[k]);
                is_removable_[i][k] = false;
            }
        }
    }

private:
    [[nodiscard]] Outboxes outboxes(auto&& is_sent) {
        Outboxes all(ranks_.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& vertices = sharing_->neighbours()[i].entities;
            for (std::size_t k = 0; k < vertices.size(); ++k) {
                if (is_sent(i, k, vertices[k])) all[i].push_back(static_cast<std::uint32_t>(k));
            }
        }
        return all;
    }

    const Sharing<VertexIndex>* sharing_;
    std::vector<int> ranks_;
    std::vector<std::vector<bool>> is_removable_;  ///< as this process has sent or received
};

std::uint64_t count_of(const Outboxes& outboxes) {
    std::uint64_t count = 0;
    for (const auto& outbox : outboxes) count += outbox.size();
    return count;
}

}  // namespace

KeptVertices find_kept_vertices(const DistributedMesh& mesh, const Sharing<VertexIndex>& sharing,
                                const MarkedCells& marked, Adjacency* adjacency) {
    const Communicator& processes = mesh.processes;
    KeptVertexSearch search(mesh, marked, adjacency);
    KeptVertexExchange kept_exchange(sharing);
    kept_exchange.apply_initial(
        processes.exchange_with(kept_exchange.ranks(), kept_exchange.first(search)), search);
    while (true) {
        do {
            search.close();
        } while (mesh.closure == Closure::regular && search.complete_families());
        const Outboxes outboxes = kept_exchange.pending(search);
        if (processes.max(count_of(outboxes)) == 0) return std::move(search).result();
        kept_exchange.apply(processes.exchange_after_agreement(kept_exchange.ranks(), outboxes),
                            search);
    }
}

}  // namespace octetra::distributed
