#include "coarsen/kept_vertices.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <octetra/core/edge_order.hpp>

#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

class Keeping {
public:
    Keeping(const DistributedMesh& mesh, std::span<const std::uint8_t> may_go)
        : mesh_(&mesh), levels_(mesh), may_go_(may_go), kept_(mesh.points.size(), 0) {
        std::fill_n(kept_.begin(), mesh.input_vertices.size(), std::uint8_t{1});
        keep_what_cells_need();
    }

    void keep(VertexIndex v) { kept_[v] = 1; }
    /// Without a branch, which could not be foreseen.
    void keep_if(VertexIndex v, bool condition) {
        kept_[v] = static_cast<std::uint8_t>(kept_[v] | (condition ? 1U : 0U));
    }
    [[nodiscard]] bool has(VertexIndex v) const { return kept_[v] != 0; }
    [[nodiscard]] KeptVertices result() && { return std::move(kept_); }

    /// Rule (b), as far as this process sees: again and again until nothing changes.
    void close() {
        if (!is_any_level_divided()) return;
        const std::size_t count = mesh_->cells.size();
        bool changed = true;
        for (bool backwards = false; changed; backwards = !backwards) {
            changed = false;
            for (std::size_t k = 0; k < count; ++k) {
                const CellIndex c{backwards ? count - 1 - k : k};
                if (may_go_[c.value()] != 0 && close(mesh_->cells[c])) changed = true;
            }
        }
    }

private:
    /// Are there midpoints of one level of which some stay and some may go?
    [[nodiscard]] bool is_any_level_divided() const {
        for (std::uint32_t level = 1; level <= levels_.count(); ++level) {
            const std::size_t end = std::min<std::size_t>(levels_.end(level).value(), kept_.size());
            const auto first = kept_.begin() + levels_.begin(level).value();
            const auto last = kept_.begin() + static_cast<std::ptrdiff_t>(end);
            if (std::find(first, last, 0) != last && std::find(first, last, 1) != last) return true;
        }
        return false;
    }
    /// Rule (a).
    void keep_what_cells_need() {
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            const CellVertices& cell = mesh_->cells[c];
            // Its parent has been cut, and its own level's vertices may be of no other such cell.
            const VertexIndex first_new =
                may_go_[c.value()] == 0 ? VertexIndex::none() : levels_.begin(levels_.newest(cell));
            for (const VertexIndex v : cell) keep_if(v, v < first_new);
        }
    }

    bool close(const CellVertices& cell) {
        const VertexIndex first_new = levels_.begin(levels_.newest(cell));
        unsigned kept = 0;
        unsigned kept_new = 0;
        for (const VertexIndex v : cell) {
            kept += kept_[v];
            kept_new += v < first_new ? 0U : kept_[v];
        }
        if (kept == cell.size() || kept_new == 0) return false;
        bool changed = false;
        for (const VertexIndex v : cell) {
            if (has(v)) continue;
            for (const VertexIndex other : cell) {
                if (other < first_new || !has(other) || !is_longest_of_face(v, other)) continue;
                keep(v);
                changed = true;
                break;
            }
        }
        return changed;
    }
    /// Of two midpoints of one level that an edge of the mesh joins: do both lie in a face whose
    /// longest edge is that of the first?
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
    std::span<const std::uint8_t> may_go_;
    KeptVertices kept_;
};

using Outboxes = std::vector<std::vector<std::uint32_t>>;

/// What this process has told others about the vertices that it shares with them, as positions in
/// lists that both sides have.
class Told {
public:
    explicit Told(const Sharing<VertexIndex>& sharing) : sharing_(&sharing) {
        for (const auto& with : sharing.neighbours()) {
            ranks_.push_back(with.rank);
            may_go_.emplace_back(with.entities.size(), false);
        }
    }
    [[nodiscard]] const std::vector<int>& ranks() const { return ranks_; }

    /// Those that may go for all that this process knows.
    [[nodiscard]] Outboxes first(const Keeping& keeping) {
        return outboxes([&](std::size_t i, std::size_t k, VertexIndex v) {
            may_go_[i][k] = !keeping.has(v);
            return may_go_[i][k];
        });
    }
    void hear_first(const Outboxes& inboxes, Keeping& keeping) {
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            const auto& vertices = sharing_->neighbours()[i].entities;
            auto next = inboxes[i].begin();
            for (std::size_t k = 0; k < vertices.size(); ++k) {
                if (next != inboxes[i].end() && *next == k) {
                    ++next;
                    continue;
                }
                keeping.keep(vertices[k]);
                may_go_[i][k] = false;  // the other side knows
            }
        }
    }
    /// Those that stay, and that was not told before.
    [[nodiscard]] Outboxes news(const Keeping& keeping) {
        return outboxes([&](std::size_t i, std::size_t k, VertexIndex v) {
            const bool is_news = may_go_[i][k] && keeping.has(v);
            if (is_news) may_go_[i][k] = false;
            return is_news;
        });
    }
    void hear(const Outboxes& inboxes, Keeping& keeping) {
        for (std::size_t i = 0; i < inboxes.size(); ++i) {
            for (const std::uint32_t k : inboxes[i]) {
                keeping.keep(sharing_->neighbours()[i].entities[k]);
                may_go_[i][k] = false;
            }
        }
    }

private:
    [[nodiscard]] Outboxes outboxes(auto&& is_told) {
        Outboxes all(ranks_.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& vertices = sharing_->neighbours()[i].entities;
            for (std::size_t k = 0; k < vertices.size(); ++k) {
                if (is_told(i, k, vertices[k])) all[i].push_back(static_cast<std::uint32_t>(k));
            }
        }
        return all;
    }

    const Sharing<VertexIndex>* sharing_;
    std::vector<int> ranks_;
    std::vector<std::vector<bool>> may_go_;  ///< as this process told it, or heard
};

std::uint64_t count_of(const Outboxes& outboxes) {
    std::uint64_t count = 0;
    for (const auto& outbox : outboxes) count += outbox.size();
    return count;
}

}  // namespace

KeptVertices find_kept_vertices(const DistributedMesh& mesh, const Sharing<VertexIndex>& sharing,
                                std::span<const std::uint8_t> may_go, LocalFailure& failure) {
    const Communicator& processes = mesh.processes;
    std::unique_ptr<Keeping> keeping;
    std::unique_ptr<Told> told;
    Outboxes outboxes;
    failure.attempt([&] {
        keeping = std::make_unique<Keeping>(mesh, may_go);
        told = std::make_unique<Told>(sharing);
        outboxes = told->first(*keeping);
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return {};
    failure.attempt([&] {
        told->hear_first(processes.exchange_with<std::uint32_t>(told->ranks(), outboxes), *keeping);
    });
    while (true) {
        failure.attempt([&] {
            keeping->close();
            outboxes = told->news(*keeping);
        });
        const std::uint64_t most = failure.max_unless_failed(processes, count_of(outboxes));
        if (most == LocalFailure::somewhere) return {};
        if (most == 0) return std::move(*keeping).result();
        failure.attempt([&] {
            told->hear(processes.exchange_with<std::uint32_t>(told->ranks(), outboxes), *keeping);
        });
    }
}

}  // namespace octetra::distributed
