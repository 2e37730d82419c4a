#include "adapt/even_level.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include <octetra/distributed/profile.hpp>

#include "adapt/even_roots.hpp"
#include "migrate/even_parts.hpp"
#include "pattern/length_order.hpp"

namespace octetra::distributed {
namespace {

/// Collective. Numbers of cells of the processes before and after the level.
struct Loads {
    std::uint64_t most_before = 0;
    std::uint64_t most = 0;
    std::uint64_t sum = 0;

    Loads(const DistributedMesh& mesh, std::uint64_t count_afterwards) {
        std::array<std::uint64_t, 2> greatest{mesh.cells.size(), count_afterwards};
        mesh.processes.max(std::span(greatest));
        most_before = greatest[0];
        most = greatest[1];
        sum = mesh.processes.sum(count_afterwards);
    }

    [[nodiscard]] bool are_uneven(const BalanceOptions& balance, int processes) const {
        return static_cast<double>(most) > balance.most_over_mean * mean(processes);
    }
    /// Returns the number of cells that the most loaded process makes while the others wait.
    [[nodiscard]] std::uint64_t idle_cells(int processes) const {
        return most - static_cast<std::uint64_t>(mean(processes));
    }

private:
    [[nodiscard]] double mean(int processes) const { return static_cast<double>(sum) / processes; }
};

/// Returns the number of cells of each root of this process after the level. The mesh must be in
/// canonical order.
std::vector<std::uint64_t> cells_of_roots_after(const DistributedMesh& mesh,
                                                const MarkedCells& marks) {
    std::vector<std::uint64_t> counts = cells_of_roots(mesh);
    const std::vector<std::uint32_t>& first = mesh.cell_ancestors.first;
    std::size_t root = 0;
    for (std::size_t k = 0; k < marks.cells.size(); ++k) {
        const CellIndex c = marks.cells[k];
        while (first[root + 1] <= c.value()) ++root;
        const LengthOrder order = length_order(mesh.points, mesh.cells[c]);
        counts[root] += PatternTable::get().pattern(order, marks.edges[k]).child_count - 1U;
    }
    return counts;
}

/// Returns the marked edges of each cell, by the numbers of cells before the canonical order was
/// established.
std::vector<EdgeMask> masks_of(const MarkedCells& marks, const std::vector<CellIndex>& before,
                               std::size_t count) {
    std::vector<EdgeMask> masks(count, 0);
    for (std::size_t k = 0; k < marks.cells.size(); ++k) {
        const CellIndex c = marks.cells[k];
        masks[before.empty() ? c.value() : before[c.value()].value()] = marks.edges[k];
    }
    return masks;
}

MarkedCells marks_of_masks(const std::vector<EdgeMask>& masks) {
    MarkedCells marks;
    for (std::size_t c = 0; c < masks.size(); ++c) {
        if (masks[c] == 0) continue;
        marks.cells.push_back(CellIndex{c});
        marks.edges.push_back(masks[c]);
    }
    marks.count = marks.cells.size();
    return marks;
}

/// Undoes a level, and returns its closed marks in the canonical order that the mesh is in then.
UnevenLevel undo_level(DistributedMesh& mesh, PlannedLevel& plan) {
    UnevenLevel level;
    level.marks = plan.level->closed_marks();
    plan.level.reset();
    if (plan.order == nullptr && mesh.adjacency != nullptr) {
        plan.order = std::make_unique<CanonicalOrder>(mesh);
        level.marks = renumbered(std::move(level.marks), plan.order->cells_before());
    }
    level.order = std::move(plan.order);
    return level;
}

/// Begins a level again from its closed marks, on the mesh in its previous order.
void redo(DistributedMesh& mesh, PlannedLevel& plan, UnevenLevel level,
          const RefineOptions& options, const Tuning& tuning) {
    MarkedCells marks = std::move(level.marks);
    if (level.order != nullptr && !level.order->cells_before().empty()) {
        for (CellIndex& c : marks.cells) c = level.order->cells_before()[c.value()];
    }
    level.order.reset();
    begin_level(mesh, options, tuning, std::move(marks), plan);
}

}  // namespace

void UnevenLevel::keep_mesh() noexcept {
    if (roots != nullptr) (void)roots->keep();
    if (order != nullptr) order->keep();
    roots.reset();
    order.reset();
}

std::optional<UnevenLevel> uneven_level(DistributedMesh& mesh, PlannedLevel& plan,
                                        const BalanceOptions& balance, const RefineOptions& options,
                                        const Tuning& tuning, std::uint64_t& accumulated_idle,
                                        const CanonicalNumbers* known) {
    const Communicator& processes = mesh.processes;
    if (processes.size() == 1) return std::nullopt;
    const Loads loads(mesh, plan.level->cell_count_afterwards());
    if (loads.sum > options.max_cells) return std::nullopt;  // bisect_level() throws
    if (!loads.are_uneven(balance, processes.size())) return std::nullopt;
    accumulated_idle += loads.idle_cells(processes.size());
    if (balance.only_if_it_pays && accumulated_idle <= 2 * loads.most_before) return std::nullopt;
    accumulated_idle = 0;

    UnevenLevel level = undo_level(mesh, plan);
    const auto weigh = [&] { return cells_of_roots_after(mesh, level.marks); };
    if (auto parts = even_parts_or_roots(mesh, std::ref(weigh), balance, level.roots, known)) {
        level.rank_of_root = *std::move(parts);
        return level;
    }
    redo(mesh, plan, std::move(level), options, tuning);
    return std::nullopt;
}

MovedLevel moved_level(const AdaptiveMesh::State& state, const UnevenLevel& level,
                       const RefineOptions& options, const Tuning& tuning) {
    const Phase phase(state.mesh.processes, "migrate");
    static const std::vector<CellIndex> same;
    const auto& before = level.order == nullptr ? same : level.order->cells_before();
    MovedLevel moved{moved_state(state, before, level.rank_of_root), {}};
    const std::vector<EdgeMask> masks =
        moved.to.migration.cells(masks_of(level.marks, before, state.mesh.cells.size()));
    begin_level(moved.to.state->mesh, options, tuning, marks_of_masks(masks), moved.plan);
    return moved;
}

}  // namespace octetra::distributed
