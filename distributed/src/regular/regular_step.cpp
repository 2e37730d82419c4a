#include "regular/regular_step.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "level/incremental/adjacency.hpp"
#include "level/incremental/suits_incremental_level.hpp"
#include "pattern/length_order.hpp"
#include "regular/family_order.hpp"
#include "regular/transition_cells_of.hpp"

namespace octetra::distributed {
namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// The canonical order of a mesh as a change that was made to it.
class OrderedMesh final : public MadeChange {
public:
    explicit OrderedMesh(DistributedMesh& mesh) : order_(mesh) {}
    void keep() noexcept override { order_.keep(); }
    [[nodiscard]] const CanonicalOrder& order() const { return order_; }

private:
    CanonicalOrder order_;
};

/// Returns the edges of a cell that are in the list.
unsigned edges_among(const CellVertices& cell, const std::vector<EdgeVertices>& edges) {
    unsigned found = 0;
    for (const auto& [a, b] : edges) {
        const auto i = std::ranges::find(cell, a) - cell.begin();
        const auto j = std::ranges::find(cell, b) - cell.begin();
        if (i == 4 || j == 4) continue;
        const std::array ends{static_cast<std::uint8_t>(std::min(i, j)),
                              static_cast<std::uint8_t>(std::max(i, j))};
        found |= 1U << (std::ranges::find(cell_edges, ends) - cell_edges.begin());
    }
    return found;
}

TransitionCells transition_cells(const AdaptiveMesh::State& state) {
    if (state.transition_kinds.size() != state.mesh.cells.size()) {
        return transition_cells_of(state.mesh);
    }
    return {state.mesh, state.transition_kinds, generations_of(state.mesh)};
}

}  // namespace

RegularStep::RegularStep(AdaptiveMesh::State& state, const RefineOptions& options,
                         const Tuning& tuning)
    : state_(&state),
      mesh_(&state.mesh),
      options_(options),
      max_cells_(options.max_cells),
      tuning_(tuning),
      before_{state.mesh.points.end_index(), state.mesh.level_begin},
      cell_count_before_(state.mesh.cells.size()),
      facet_count_before_(state.mesh.facets.size()),
      edge_count_before_(state.mesh.edges.size()),
      cells_(transition_cells(state)),
      of_cells_(cell_count_before_),
      of_facets_(facet_count_before_),
      of_edges_(edge_count_before_),
      new_shared_(state.mesh.interfaces.size()) {
    options_.max_cells = no_limit;  // until a level of the step is done
}

bool RegularStep::plan(const MarkedCells& marked) {
    if (mesh_->processes.max(marked.cells.empty() ? 0 : 1) == 0) return false;
    mark(marked);
    bisect_all();
    order_.emplace(*mesh_, before_, cells_.generations());
    number_vertices(shared_after());
    describe();
    return true;
}

void RegularStep::mark(const MarkedCells& marked) {
    for (const CellIndex c : marked.cells) {
        if (!cells_.contains(c)) {
            pending_.add_open(c, all_edges);
            continue;
        }
        for (const CellIndex sibling : cells_.family_of(c)) {
            pending_.add_open(sibling, cells_.edges_of_parent(sibling));
        }
        if (is_one_of_eight(c, cells_.generation_of(c) - 1)) pending_.add_open(c, all_edges);
    }
}

/// Returns whether a transition cell is one of the children that its parent, of this generation,
/// has if all its edges are bisected.
bool RegularStep::is_one_of_eight(CellIndex cell, std::uint32_t generation) const {
    const DividedCell parent(*mesh_, cells_, cells_.family_of(cell), generation);
    const LengthOrder order = length_order(mesh_->points, parent.corners());
    const Pattern& pattern = PatternTable::get().pattern(order, all_edges);
    return std::ranges::any_of(pattern.children, [&](const auto& places) {
        return std::ranges::is_permutation(child_of(parent.vertices, places), mesh_->cells[cell]);
    });
}

/// Collective. Bisects edges until none is pending.
void RegularStep::bisect_all() {
    for (bool is_alone = true;;) {
        PlannedLevel closed = close_open();
        const auto [least, greatest] = pending_.generations(mesh_->processes);
        if (least > greatest) return;
        const bool is_last = least == greatest;
        if (is_alone && is_last && closed.changes_anything()) {
            (void)pending_.take(least);  // as `closed` has them
            bisect(least, std::move(closed));
        } else {
            closed = {};
            bisect(least, pending_level(least));
        }
        is_alone = is_last;
        check_allowed();
    }
}

/// Collective. Closes the open edges. Returns the level that bisects these, or an empty one on all
/// processes if there are none.
PlannedLevel RegularStep::close_open() {
    MarkedCells open = pending_.take_open();
    prepare_order(open);
    PlannedLevel closed = close_level(
        *mesh_, [&] { return std::move(open); }, options_, tuning_, &cells_);
    if (std::exchange(is_first_, false)) {
        options_.is_last = false;  // further levels of the step follow
        // Their marks are closed, and so list all cells at the marked edges.
        tuning_.incremental_below *= 4;
    }
    if (!closed.changes_anything()) return closed;
    counts_ += closed.counts;
    pending_.add(closed.level->closed_marks(), cells_);
    return closed;
}

/// Returns the level that bisects the closed edges of a generation.
PlannedLevel RegularStep::pending_level(std::uint32_t generation) {
    MarkedCells marked = pending_.take(generation);
    prepare_order(marked);
    PlannedLevel plan;
    begin_level(*mesh_, options_, tuning_, std::move(marked), plan);
    return plan;
}

/// Puts the mesh into canonical order if the level of the marked cells requires it.
void RegularStep::prepare_order(MarkedCells& marked) {
    if (mesh_->adjacency == nullptr) return;
    if (suits_incremental_level(*mesh_, marked, tuning_, options_.is_last)) return;
    const CanonicalOrder* order = nullptr;
    changes_.add([&] {
        auto made = std::make_unique<OrderedMesh>(*mesh_);
        order = &made->order();
        return made;
    });
    of_cells_.reorder(order->cells_before());
    of_facets_.reorder(order->facets_before());
    of_edges_.reorder(order->edges_before());
    const auto& before = order->cells_before();
    if (before.empty()) return;
    marked = renumbered(std::move(marked), before);
    pending_.reorder(before);
    TransitionCells::Kinds kinds;
    kinds.reserve(before.size());
    for (const CellIndex c : before) kinds.push_back(cells_.kinds()[c]);
    cells_.kinds().swap(kinds);
}

/// Collective. Bisects the edges of a generation.
void RegularStep::bisect(std::uint32_t generation, PlannedLevel plan) {
    bisect_level(plan, *mesh_, options_, static_cast<int>(generation) + 1);
    const MarkedCells bisected = plan.level->closed_marks();
    const ListChanges changes = plan.changes();
    const auto shared = plan.level->shared_midpoints();
    for (std::size_t i = 0; i < shared.size(); ++i) {
        new_shared_[i].insert(new_shared_[i].end(), shared[i].begin(), shared[i].end());
    }
    DividedFamilies families = divided_families(bisected);
    changes_.add([&] { return plan.level->commit_reversibly(); });
    plan = {};
    cells_.add_midpoints(generation);
    of_cells_.append(changes.cells);
    of_facets_.append(changes.facets);
    of_edges_.append(changes.edges);
    const Children children(*mesh_, changes.cells);

    pending_.renumber([&](CellIndex c) { return children.same(c); });
    update_kinds(bisected, children);
    update_families(families, children, generation);
}

/// Returns the families with bisected cells, and removes the pending edges of their cells.
RegularStep::DividedFamilies RegularStep::divided_families(const MarkedCells& bisected) {
    std::vector<CellIndex> first;
    for (const CellIndex c : bisected.cells) {
        if (cells_.contains(c)) first.push_back(cells_.family_of(c)[0]);
    }
    std::ranges::sort(first);
    first.erase(std::unique(first.begin(), first.end()), first.end());
    DividedFamilies families;
    families.reserve(first.size());
    for (const CellIndex c : first) families.push_back({cells_.family_of(c), {}, {}});
    for (DividedFamily& family : families) find_pending(family);
    return families;
}

void RegularStep::find_pending(DividedFamily& family) {
    for (const CellIndex c : family.siblings) {
        const unsigned edges = pending_.take_of(c);
        for (std::size_t e = 0; edges >> e != 0; ++e) {
            if ((edges >> e & 1U) == 0) continue;
            const auto& [i, j] = cell_edges[e];
            family.pending.push_back({mesh_->cells[c][i], mesh_->cells[c][j]});
        }
    }
}

void RegularStep::update_kinds(const MarkedCells& bisected, const Children& children) {
    TransitionCells::Kinds& kinds = cells_.kinds();
    const std::size_t count_before = kinds.size();
    std::vector<CellIndex> regular;
    for (const CellIndex c : bisected.cells) {
        if (!cells_.contains(c)) regular.push_back(c);
    }
    if (mesh_->adjacency == nullptr) {
        TransitionCells::Kinds after;
        after.assign(mesh_->cells.size(), TransitionCells::Kind::regular);
        for (CellIndex c{0}; c < CellIndex{count_before}; ++c) after[children.same(c)] = kinds[c];
        kinds = std::move(after);
    } else {
        make_room(kinds, mesh_->cells.size());
        kinds.resize(mesh_->cells.size(), TransitionCells::Kind::regular);
    }
    for (const CellIndex c : regular) {
        CellRun run;
        children.append_of(c, run);
        cells_.set_run(run);
    }
}

void RegularStep::update_families(DividedFamilies& families, const Children& children,
                                  std::uint32_t generation) {
    FamilyOrder* order = nullptr;
    changes_.add([&] {
        auto made = std::make_unique<FamilyOrder>(*mesh_);
        order = made.get();
        return made;
    });
    for (DividedFamily& family : families) {
        for (const CellIndex c : family.siblings) children.append_of(c, family.pieces);
        order->restore(cells_, family.pieces, generation, of_cells_);
        cells_.set_run(family.pieces);
        // An edge of a bisected cell that is not bisected is an edge of some piece of its family.
        for (const CellIndex piece : family.pieces) {
            pending_.add_open(piece, edges_among(mesh_->cells[piece], family.pending));
        }
    }
}

/// Collective.
void RegularStep::check_allowed() const {
    if (max_cells_ == no_limit) return;
    if (mesh_->processes.sum(mesh_->cells.size()) <= max_cells_) return;
    throw InputError(fmt::format(
        "the step would make more than the {} cells allowed: mark fewer cells, or allow more",
        max_cells_));
}

}  // namespace octetra::distributed
