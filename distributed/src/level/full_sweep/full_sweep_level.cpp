#include "level/full_sweep/full_sweep_level.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <octetra/core/huge_pages.hpp>
#include <octetra/distributed/profile.hpp>

#include "level/full_sweep/bisect_edges.hpp"
#include "level/full_sweep/bisect_interfaces.hpp"
#include "level/rounding_margin.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {
namespace {

constexpr std::size_t max_children = 8;

class CellBisection {
public:
    CellBisection(const DistributedMesh& mesh, const EdgeNumbering& numbering, CellOrders& orders,
                  const IndexVector<CellIndex, EdgeMask>& marked,
                  const IndexVector<EdgeIndex, VertexIndex>& midpoints)
        : mesh_(&mesh),
          numbering_(&numbering),
          orders_(&orders),
          marked_(&marked),
          midpoints_(&midpoints) {}

    /// Computes the `child_count` children of all cells, and the offset of those of each root.
    [[nodiscard]] RoundingFailure run(std::size_t child_count,
                                      IndexVector<CellIndex, CellVertices>& children,
                                      std::vector<std::uint32_t>& first) {
        reserve_in_huge_pages(children_, child_count);
        const AncestorMap& ancestors = mesh_->cell_ancestors;
        reserve_in_huge_pages(first, ancestors.first.size());
        for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
            const CellIndex end{ancestors.first[r + 1]};
            first.push_back(static_cast<std::uint32_t>(children_.size() + written_));
            for (CellIndex c{ancestors.first[r]}; c < end; ++c) {
                if (c == block_end_) begin_block();
                bisect(c, ancestors.roots[r]);
            }
        }
        append_written();
        first.push_back(children_.end_index().value());
        children = std::move(children_);
        return failure_;
    }

private:
    static constexpr std::size_t block_size = 64;

    /// Determines the patterns of the next 64 cells, and then their rounding margins: loops of one
    /// operation over several cells allow the processor to overlap them.
    void begin_block() {
        append_written();
        std::array<CellIndex, block_size> touched;
        std::size_t touched_count = 0;
        const std::size_t end = std::min(mesh_->cells.size(), block_end_.value() + block_size);
        for (; block_end_ < CellIndex{end}; ++block_end_) {
            touched[touched_count] = block_end_;
            touched_count += (*marked_)[block_end_] != 0 ? 1U : 0U;
        }
        const auto all_touched = std::span(touched).first(touched_count);
        for (const CellIndex c : all_touched) {
            patterns_[index_in_block(c)] = &table_->pattern(orders_->of(c), (*marked_)[c]);
        }
        for (const CellIndex c : all_touched) {
            is_safe_[index_in_block(c)] = has_rounding_margin(mesh_->points, mesh_->cells[c]);
        }
    }
    static std::size_t index_in_block(CellIndex cell) { return cell.value() % block_size; }

    void append_written() {
        children_.insert(children_.end(), block_.begin(),
                         block_.begin() + static_cast<std::ptrdiff_t>(written_));
        written_ = 0;
    }

    void bisect(CellIndex c, std::uint64_t root) {
        const CellVertices& cell = mesh_->cells[c];
        if ((*marked_)[c] == 0) {
            block_[written_++] = cell;
            return;
        }
        const Pattern& pattern = *patterns_[index_in_block(c)];
        std::array<VertexIndex, 10> vertices;  // corners, then midpoints of edges
        std::ranges::copy(cell, vertices.begin());
        const auto& edges = numbering_->edges_of(c);
        for (std::size_t e = 0; e < 6; ++e) vertices[4 + e] = (*midpoints_)[edges[e]];
        // Always eight, since writing superfluous children takes less time than a mispredicted
        // branch on their number.
        CellVertices* const children = block_.data() + written_;
        for (std::size_t k = 0; k < max_children; ++k) {
            children[k] = child_of(vertices, pattern.children[k]);
        }
        const std::size_t count = pattern.child_count;
        if (!is_safe_[index_in_block(c)]) check({children, count}, root);
        written_ += count;
    }

    void check(std::span<const CellVertices> children, std::uint64_t root) {
        for (const CellVertices& child : children) {
            if (failure_.found()) return;
            const int sign = sign_of(child, mesh_->points);
            if (sign <= 0) failure_.note(root, sign);
        }
    }

    const DistributedMesh* mesh_;
    const EdgeNumbering* numbering_;
    CellOrders* orders_;
    const IndexVector<CellIndex, EdgeMask>* marked_;
    const IndexVector<EdgeIndex, VertexIndex>* midpoints_;
    const PatternTable* table_ = &PatternTable::get();
    IndexVector<CellIndex, CellVertices> children_;
    RoundingFailure failure_;

    CellIndex block_end_{0};  ///< blocks begin at multiples of block_size
    std::array<const Pattern*, block_size> patterns_{};
    std::array<bool, block_size> is_safe_{};
    /// Children to be appended: an immediate copy of data just written takes longer.
    std::array<CellVertices, block_size * max_children> block_;
    std::size_t written_ = 0;
};

}  // namespace

/// Returns a list in which all entities are replaced by their children: append_children(entity,
/// pieces) is called for each in order, and returns its division.
template <class List>
FullSweepLevel::NewList<List> FullSweepLevel::replaced_by_children(const List& list,
                                                                   const AncestorMap& ancestors,
                                                                   auto&& append_children) {
    NewList<List> pieces;
    pieces.first.reserve(ancestors.first.size());
    pieces.divisions.reserve(list.size());
    auto entity = list.begin();
    for (const std::uint32_t begin : ancestors.first) {
        for (; entity < list.begin() + begin; ++entity) {
            pieces.divisions.push_back(append_children(*entity, pieces.entities));
        }
        pieces.first.push_back(pieces.entities.end_index().value());
    }
    return pieces;
}

FullSweepLevel::FullSweepLevel(DistributedMesh& mesh, const MarkedCells& marked, double local_below,
                               const TransitionCells* transition)
    : mesh_(&mesh),
      edges_(in_phase(mesh.processes, "number edges",
                      [&] { return LocalEdgeSet(mesh, marked, local_below); })),
      orders_(mesh),
      closure_(edges_, orders_, mesh.interfaces, transition) {}

void FullSweepLevel::mark(const MarkedCells& marked, Scheme scheme) {
    if (marked.all && scheme == Scheme::eight) {
        closure_.mark_all();
    } else if (marked.all) {
        for (CellIndex c{0}; c < mesh_->cells.end_index(); ++c) {
            mark(c, marks_of(scheme, orders_.of(c)));
        }
    } else {
        for (std::size_t k = 0; k < marked.cells.size(); ++k) {
            const CellIndex c = marked.cells[k];
            mark(c, marked.edges.empty() ? marks_of(scheme, orders_.of(c)) : marked.edges[k]);
        }
    }
}

void FullSweepLevel::mark(CellIndex cell, EdgeMask mask) {
    const auto edges = numbering_->edges_of(cell);
    for (std::size_t e = 0; e < 6; ++e) {
        if ((unsigned{mask} >> e & 1U) != 0) closure_.mark(edges[e]);
    }
}

void FullSweepLevel::bisect_edges() {
    appended_ = std::make_unique<AppendedMidpoints>(*mesh_);
    midpoints_ = distributed::bisect_edges(*mesh_, *numbering_, closure_);
}

std::size_t FullSweepLevel::cell_count_afterwards() {
    const std::size_t cell_count = mesh_->cells.size();
    if (closure_.all_marked()) {
        marked_.assign(cell_count, all_edges);
        return max_children * cell_count;
    }
    marked_.assign(cell_count, 0);
    // Cells outside the set have no marked edges.
    std::size_t count = cell_count - numbering_->cell_count();
    for (std::size_t k = 0; k < numbering_->cell_count(); ++k) {
        const CellIndex c = numbering_->cell_at(k);
        const EdgeMask marked = closure_.marked_of(c);
        marked_[c] = marked;
        // The first two cases do not need the length order.
        if (marked == 0) {
            ++count;
        } else if (marked == all_edges) {
            count += max_children;
        } else {
            count += PatternTable::get().pattern(orders_.of(c), marked).child_count;
        }
    }
    return count;
}

MarkedCells FullSweepLevel::closed_marks() {
    if (marked_.empty()) (void)cell_count_afterwards();
    MarkedCells closed;
    for (CellIndex c{0}; c < marked_.end_index(); ++c) {
        if (marked_[c] == 0) continue;
        closed.cells.push_back(c);
        closed.edges.push_back(marked_[c]);
    }
    closed.count = closed.cells.size();
    return closed;
}

RoundingFailure FullSweepLevel::bisect_cells(std::size_t cell_count) {
    return CellBisection(*mesh_, *numbering_, orders_, marked_, midpoints_)
        .run(cell_count, lists_.cells.entities, lists_.cells.first);
}

void FullSweepLevel::bisect_tagged() {
    const DistributedMesh& mesh = *mesh_;
    lists_.facets = replaced_by_children(
        mesh.facets, mesh.facet_ancestors, [&](const FacetVertices& facet, auto& all) {
            const BisectedTriangle bisected =
                bisect_triangle(facet, midpoints_of(facet, *numbering_, midpoints_), mesh.points);
            std::copy_n(bisected.pieces.begin(), bisected.piece_count, std::back_inserter(all));
            return division_of(bisected);
        });
    lists_.edges = replaced_by_children(
        mesh.edges, mesh.edge_ancestors, [&](const EdgeVertices& edge, auto& all) {
            // The order of the halves depends on the order of the ends in the list.
            const VertexIndex midpoint = midpoints_[numbering_->find(edge[0], edge[1])];
            const bool is_whole = midpoint.is_none();
            all.append({edge[0], is_whole ? edge[1] : midpoint});
            if (!is_whole) all.append({midpoint, edge[1]});
            return static_cast<std::uint8_t>(is_whole ? 0 : 1);
        });
}

void FullSweepLevel::bisect_interfaces() {
    lists_.interfaces = mesh_->interfaces;
    distributed::bisect_interfaces(lists_.interfaces, mesh_->points, *numbering_, midpoints_);
}

// The first half of a bisected edge replaces it; see bisect_interfaces().
std::vector<std::vector<VertexIndex>> FullSweepLevel::shared_midpoints() const {
    const VertexIndex first_midpoint = mesh_->level_begin.back();
    std::vector<std::vector<VertexIndex>> midpoints(lists_.interfaces.size());
    for (std::size_t i = 0; i < lists_.interfaces.size(); ++i) {
        for (std::size_t k = 0; k < mesh_->interfaces[i].edges.size(); ++k) {
            const VertexIndex end = lists_.interfaces[i].edges[k][1];
            if (end >= first_midpoint) midpoints[i].push_back(end);
        }
    }
    return midpoints;
}

EntityTransfer FullSweepLevel::changes_of_cells() {
    const PatternTable& table = PatternTable::get();
    std::vector<std::uint8_t> divisions(marked_.size(), 0);
    for (CellIndex c{0}; c < marked_.end_index(); ++c) {
        if (marked_[c] == 0) continue;
        // The division into eight children does not depend on the order.
        const LengthOrder order = marked_[c] == all_edges ? LengthOrder{0} : orders_.of(c);
        divisions[c.value()] = table.pattern(order, marked_[c]).division;
    }
    return EntityTransfer::of_all(std::move(divisions), table.divisions());
}

ListChanges FullSweepLevel::changes() {
    return {changes_of_cells(),
            EntityTransfer::of_all(std::move(lists_.facets.divisions), triangle_divisions),
            EntityTransfer::of_all(std::move(lists_.edges.divisions), edge_divisions)};
}

void FullSweepLevel::Lists::swap(DistributedMesh& mesh) noexcept {
    cells.swap(mesh.cells, mesh.cell_ancestors);
    facets.swap(mesh.facets, mesh.facet_ancestors);
    edges.swap(mesh.edges, mesh.edge_ancestors);
    mesh.interfaces.swap(interfaces);
}

void FullSweepLevel::commit() noexcept {
    lists_.swap(*mesh_);
    lists_ = {};
    appended_->keep();
}

/// Has the lists before the level until it is kept.
class FullSweepLevel::MadeLevel final : public MadeChange {
public:
    explicit MadeLevel(DistributedMesh& mesh) : mesh_(&mesh) {}
    ~MadeLevel() override {
        if (appended_ == nullptr) return;
        mesh_->adjacency.reset();  // a later level may have created it
        lists_.swap(*mesh_);
    }
    MadeLevel(const MadeLevel&) = delete;
    MadeLevel& operator=(const MadeLevel&) = delete;
    MadeLevel(MadeLevel&&) = delete;
    MadeLevel& operator=(MadeLevel&&) = delete;

    void make(Lists&& lists, std::unique_ptr<AppendedMidpoints> appended) noexcept {
        appended_ = std::move(appended);
        lists_ = std::move(lists);
        lists_.swap(*mesh_);
    }
    void keep() noexcept override {
        appended_->keep();
        appended_.reset();
        lists_ = {};
    }

private:
    DistributedMesh* mesh_;
    std::unique_ptr<AppendedMidpoints> appended_;
    Lists lists_;
};

std::unique_ptr<MadeChange> FullSweepLevel::commit_reversibly() {
    auto made = std::make_unique<MadeLevel>(*mesh_);
    made->make(std::move(lists_), std::move(appended_));
    return made;
}

}  // namespace octetra::distributed
