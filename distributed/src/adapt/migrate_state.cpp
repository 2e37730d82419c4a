#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/mesh_part.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "comm/local_failure.hpp"
#include "history/replay.hpp"
#include "history/steps_of.hpp"
#include "level/incremental/adjacency.hpp"
#include "migrate/even_parts.hpp"
#include "migrate/migration_messages.hpp"
#include "migrate/move_roots.hpp"

namespace octetra::distributed {
namespace {

void check_ranks(const DistributedMesh& mesh, std::span<const int> rank_of_root) {
    const Communicator& processes = mesh.processes;
    const std::size_t root_count = mesh.cell_ancestors.roots.size();
    if (rank_of_root.size() != root_count) {
        throw InputError(fmt::format("rank {}: {} ranks for {} cells of the input",
                                     processes.rank(), rank_of_root.size(), root_count));
    }
    for (const int rank : rank_of_root) {
        if (rank >= 0 && rank < processes.size()) continue;
        throw InputError(fmt::format("rank {}: a cell is to go to rank {}, and there are {}",
                                     processes.rank(), rank, processes.size()));
    }
}

/// Collective. The part that has come, after all steps.
std::unique_ptr<AdaptiveMesh::State> state_of(const Communicator& processes, MeshPart input,
                                              CutRoots cuts, std::size_t step_count) {
    auto state =
        std::make_unique<AdaptiveMesh::State>(distribute_parts(processes, std::move(input)));
    const Phase phase(processes, "replay");
    LocalFailure failure;
    std::optional<CutMarks> history;
    failure.attempt([&] { history.emplace(std::move(cuts)); });
    failure.agree(processes);
    for (std::size_t t = 0; t < step_count; ++t) {
        PlannedLevel plan = plan_step(state->mesh, *history, {}, static_cast<int>(t) + 1);
        state->commit(plan, [] {});
    }
    return state;
}

/// Collective. Of a state in canonical order, where each cell had the number `cells_outside` says.
Migration migrate_ordered(AdaptiveMesh::State& state, std::span<const CellIndex> cells_outside,
                          std::span<const int> rank_of_root,
                          std::unique_ptr<AdaptiveMesh::State>& after) {
    const DistributedMesh& mesh = state.mesh;
    LocalFailure failure;
    CutRoots cuts;
    failure.attempt([&] { cuts = cut_roots_of(steps_of(mesh), mesh.cell_ancestors.first); });
    MovedRoots moved = move_roots(mesh, cuts, rank_of_root, failure);
    failure.agree(mesh.processes);
    after = state_of(mesh.processes, std::move(moved.input), std::move(moved.cuts),
                     mesh.level_begin.size());
    Migration migration;
    failure.attempt([&] {
        const CanonicalOrder order(after->mesh);
        migration = migration_of(
            {&mesh, cells_outside, &state.numbers, rank_of_root},
            {&after->mesh, order.cells_before(), &after->numbers, moved.came_from}, state.sharing);
    });
    failure.agree(mesh.processes);
    return migration;
}

}  // namespace

Migration migrate_state(AdaptiveMesh::State& state, std::span<const int> rank_of_root) {
    const Communicator& processes = state.mesh.processes;
    const Phase phase(processes, "migrate");
    LocalFailure failure;
    failure.attempt([&] { check_ranks(state.mesh, rank_of_root); });
    failure.agree(processes);
    const auto stays = [&](int rank) { return rank == processes.rank(); };
    if (processes.max(std::ranges::all_of(rank_of_root, stays) ? 0 : 1) == 0) return {};

    std::optional<CanonicalOrder> order;
    failure.attempt([&] { order.emplace(state.mesh); });
    failure.agree(processes);
    std::unique_ptr<AdaptiveMesh::State> after;
    Migration migration = migrate_ordered(state, order->cells_before(), rank_of_root, after);
    order.reset();
    state = std::move(*after);
    return migration;
}

Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options) {
    const Communicator& processes = state.mesh.processes;
    check_same(processes, options);
    const auto count = static_cast<std::uint64_t>(state.mesh.cells.size());
    const auto mean =
        static_cast<double>(processes.sum(count)) / static_cast<double>(processes.size());
    if (static_cast<double>(processes.max(count)) <= options.most_over_mean * mean) return {};
    LocalFailure failure;
    std::optional<std::vector<int>> ranks;
    {
        std::optional<CanonicalOrder> order;
        failure.attempt([&] { order.emplace(state.mesh); });
        failure.agree(processes);
        ranks = even_parts(state.mesh, failure);
        failure.agree(processes);
    }
    return ranks ? migrate_state(state, *ranks) : Migration();
}

}  // namespace octetra::distributed
