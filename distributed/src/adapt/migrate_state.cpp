#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_roots.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "comm/local_failure.hpp"
#include "history/recall_history.hpp"
#include "history/steps_of.hpp"
#include "history/tagged_to_history.hpp"
#include "level/incremental/adjacency.hpp"
#include "migrate/border.hpp"
#include "migrate/even_parts.hpp"
#include "migrate/merge_parts.hpp"
#include "migrate/migration_messages.hpp"
#include "migrate/moved_numbers.hpp"
#include "migrate/moved_sharing.hpp"
#include "setup/find_interfaces.hpp"
#include "sharing/sharing_builder.hpp"
#include "sharing/vertex_sharing.hpp"

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
        throw InputError(
            fmt::format("rank {}: a cell is assigned to rank {}, but there are only {} ranks",
                        processes.rank(), rank, processes.size()));
    }
}

/// Collective. Returns the roots that stay and those received, as one part without interfaces, and
/// the destinations of the vertices of the input. Returns nothing if this process has failed, and
/// on all processes if one had failed before.
std::optional<MergedPart> move_roots(const AdaptiveMesh::State& state,
                                     std::span<const int> rank_of_root,
                                     std::vector<VertexDestination>& destinations,
                                     LocalFailure& failure) {
    const DistributedMesh& mesh = state.mesh;
    const Communicator& processes = mesh.processes;
    const Phase phase(processes, "move roots");
    const HasLists has(mesh);
    std::optional<Departures> departures;  // not a default object, which would allocate
    std::optional<MergedPart> merged;
    std::vector<std::vector<std::byte>> outboxes;
    failure.attempt([&] {
        departures = departures_of(mesh, rank_of_root);
        destinations = vertex_destinations(*departures, state.sharing);
        outboxes = packed_messages(*departures);
    });
    if (failure.max_unless_failed(processes, 0) == LocalFailure::somewhere) return merged;
    failure.attempt([&] {
        std::vector<RootMessage> messages;
        for (const auto& inbox : processes.all_to_all(outboxes)) {
            messages.push_back(RootMessage::unpacked(inbox));
        }
        outboxes.clear();
        const Arrivals arrivals =
            arrivals_of(messages, has, mesh.attributes_per_point, mesh.level_begin.size());
        messages.clear();
        merged = merge_parts(mesh, *departures, arrivals, has);
    });
    return merged;
}

/// The entities that a part shares with others.
struct Border {
    std::vector<Interface> interfaces;
    Sharing<VertexIndex> sharing;
};

/// Collective. Returns the border of a part whose vertices are numbered. sharing_of(mesh) returns
/// the sharing of an input.
std::optional<Border> find_border(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                                  auto&& sharing_of, LocalFailure& failure) {
    const Phase phase(mesh.processes, "find border");
    std::optional<DistributedMesh> input;
    failure.attempt([&] { input = input_of(mesh); });
    failure.agree(mesh.processes);
    std::optional<Border> border(Border{{}, sharing_of(*input)});
    const std::vector<Interface> of_input = find_interfaces(*input, border->sharing);
    SharingBuilder<VertexIndex> shared(border->sharing, mesh.processes.rank());
    failure.attempt([&] {
        for (BorderWith& with : border_after_steps(mesh, of_input)) {
            shared.share(with.interface.rank, std::move(with.midpoints));
            border->interfaces.push_back(std::move(with.interface));
        }
        shared.prepare(
            [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers.of_vertex[v]); });
    });
    failure.agree(mesh.processes);
    shared.commit();
    return border;
}

}  // namespace

std::optional<AdaptiveMesh::State> moved_state(const AdaptiveMesh::State& state,
                                               std::span<const CellIndex> unordered_cell_ids,
                                               std::span<const int> rank_of_root,
                                               Migration& migration) {
    const Communicator& processes = state.mesh.processes;
    LocalFailure failure;
    std::vector<VertexDestination> destinations;
    std::optional<MergedPart> merged = move_roots(state, rank_of_root, destinations, failure);
    failure.agree(processes);
    MovedEntities moved;
    failure.attempt([&] {
        moved = moved_entities({&state.mesh, rank_of_root, unordered_cell_ids},
                               {&merged->mesh, merged->rank_of_root}, state.sharing,
                               std::move(merged->kept_vertices));
    });
    failure.agree(processes);
    auto numbers = moved_numbers(processes, moved, state.numbers.of_vertex);
    std::optional<AdaptiveMesh::State> after;
    failure.attempt([&] {
        after.emplace();
        after->mesh = std::move(merged->mesh);
        after->numbers = {std::move(numbers), state.numbers.vertex_count};
        after->step_count = state.step_count;
        migration = Migration(processes, std::move(moved.partners), std::move(moved.cells),
                              std::move(moved.vertices));
    });
    failure.agree(processes);
    const auto sharing_of = [&](const DistributedMesh& input) {
        return moved_sharing(input, state.sharing, state.mesh.input_vertices, destinations);
    };
    std::optional<Border> border = find_border(after->mesh, after->numbers, sharing_of, failure);
    after->mesh.interfaces = std::move(border->interfaces);
    after->sharing = std::move(border->sharing);
    return after;
}

std::optional<AdaptiveMesh::State> state_of(DistributedMesh& mesh) {
    LocalFailure failure;
    CanonicalNumbers numbers;
    {
        const Phase phase(mesh.processes, "number vertices");
        numbers = canonical_numbers(mesh);
    }
    const auto sharing_of = [](const DistributedMesh& input) { return find_vertex_sharing(input); };
    std::optional<Border> border = find_border(mesh, numbers, sharing_of, failure);
    std::optional<AdaptiveMesh::State> state;
    failure.attempt([&] { state.emplace(); });
    failure.agree(mesh.processes);
    state->numbers = std::move(numbers);
    state->sharing = std::move(border->sharing);
    state->step_count = static_cast<int>(mesh.level_begin.size());
    state->mesh = std::move(mesh);
    return state;
}

Migration migrate_state(AdaptiveMesh::State& state, std::span<const int> rank_of_root) {
    const StandardArithmetic standard;
    const Communicator& processes = state.mesh.processes;
    const Phase phase(processes, "migrate");
    LocalFailure failure;
    failure.attempt([&] { check_ranks(state.mesh, rank_of_root); });
    failure.agree(processes);
    const auto stays = [&](int rank) { return rank == processes.rank(); };
    if (processes.max(std::ranges::all_of(rank_of_root, stays) ? 0 : 1) == 0)
        return unmoved(state.mesh);

    std::optional<CanonicalOrder> order;
    failure.attempt([&] { order.emplace(state.mesh); });
    failure.agree(processes);
    Migration migration;
    std::optional<AdaptiveMesh::State> after =
        moved_state(state, order->cells_before(), rank_of_root, migration);
    order->keep();
    state.replace_by(*std::move(after), nullptr);
    return migration;
}

Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options) {
    const StandardArithmetic standard;
    const Communicator& processes = state.mesh.processes;
    check_same(processes, options);
    const auto count = static_cast<std::uint64_t>(state.mesh.cells.size());
    const auto mean =
        static_cast<double>(processes.sum(count)) / static_cast<double>(processes.size());
    if (static_cast<double>(processes.max(count)) <= options.most_over_mean * mean) {
        return unmoved(state.mesh);
    }
    LocalFailure failure;
    std::optional<CanonicalOrder> order;
    failure.attempt([&] { order.emplace(state.mesh); });
    failure.agree(processes);
    std::unique_ptr<CellsAsRoots> roots;
    const auto weigh = [&] { return cells_of_roots(state.mesh); };
    const auto ranks =
        even_parts_or_roots(state.mesh, std::ref(weigh), options, roots, &state.numbers, failure);
    if (!ranks) return unmoved(state.mesh);
    if (roots != nullptr) state.reserve_history();
    const Phase phase(processes, "migrate");
    Migration migration;
    std::optional<AdaptiveMesh::State> after =
        moved_state(state, order->cells_before(), *ranks, migration);
    order->keep();
    state.replace_by(*std::move(after), std::move(roots));
    return migration;
}

Migration recall_history(AdaptiveMesh::State& state) {
    const StandardArithmetic standard;
    if (state.forgotten.empty()) return unmoved(state.mesh);
    const Phase phase(state.mesh.processes, "recall history");
    const History& before = state.forgotten.back();
    LocalFailure failure;
    std::optional<CanonicalOrder> order;
    failure.attempt([&] { order.emplace(state.mesh); });
    failure.agree(state.mesh.processes);
    const std::vector<int> ranks = ranks_of_roots(state.mesh.processes, before.cell_ancestors,
                                                  state.mesh.cell_ancestors.roots);
    Migration migration;
    std::optional<AdaptiveMesh::State> after =
        moved_state(state, order->cells_before(), ranks, migration);
    move_tagged_to_history(after->mesh, after->numbers.of_vertex, before);
    std::optional<History> history;  // not a default object, which would allocate
    failure.attempt([&] { history = joined(before, after->mesh); });
    failure.agree(state.mesh.processes);
    history->swap_with(after->mesh);
    order->keep();
    state.forgotten.pop_back();
    state.replace_by(*std::move(after), nullptr);
    return migration;
}

}  // namespace octetra::distributed
