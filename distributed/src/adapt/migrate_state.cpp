#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/distributed/out_of_memory.hpp>
#include <octetra/distributed/profile.hpp>

#include "adapt/even_roots.hpp"
#include "adapt/mesh_state.hpp"
#include "adapt/step_options.hpp"
#include "history/cut_roots.hpp"
#include "history/recall_history.hpp"
#include "history/replay.hpp"
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
        throw InputError(fmt::format(
            "rank {}: a cell is assigned to rank {}, but there {}", processes.rank(), rank,
            processes.size() == 1 ? "is only 1 rank"
                                  : fmt::format("are only {} ranks", processes.size())));
    }
}

/// Applies the steps to received roots. OutOfMemory would name rank 0 of a communicator that
/// contains this process alone, so it is replaced by bad_alloc, for which the migrating
/// communicator's rank is reported.
void replay_alone(Arrivals& arrivals, std::size_t step_count) {
    try {
        replay(arrivals.part, std::move(arrivals.cuts), step_count);
    } catch (const OutOfMemory&) {
        throw std::bad_alloc();
    }
    restore_canonical_order(arrivals.part);
}

/// Collective. Returns the roots that stay and those received, as one part without interfaces, and
/// the destinations of the vertices of the input.
MergedPart move_roots(const AdaptiveMesh::State& state, std::span<const int> rank_of_root,
                      std::vector<VertexDestination>& destinations) {
    const DistributedMesh& mesh = state.mesh;
    const Communicator& processes = mesh.processes;
    const Phase phase(processes, "move roots");
    const HasLists has(mesh);
    const Departures departures =
        departures_of(input_of(mesh), cut_roots_of(steps_of(mesh), mesh.cell_ancestors.first),
                      {rank_of_root.begin(), rank_of_root.end()});
    destinations = vertex_destinations(departures, state.sharing);
    std::vector<RootMessage> messages;
    for (const auto& inbox : processes.all_to_all(packed_messages(departures))) {
        messages.push_back(RootMessage::unpacked(inbox));
    }
    Arrivals arrivals = arrivals_of(messages, has, mesh.attributes_per_point);
    messages.clear();
    replay_alone(arrivals, mesh.level_begin.size());
    return merge_parts(mesh, departures, arrivals, has);
}

/// The entities that a part shares with others.
struct Border {
    std::vector<Interface> interfaces;
    Sharing<VertexIndex> sharing;
};

/// Collective. Returns the border of a part whose vertices are numbered. sharing_of(mesh) returns
/// the sharing of an input.
Border find_border(const DistributedMesh& mesh, const CanonicalNumbers& numbers,
                   auto&& sharing_of) {
    const Phase phase(mesh.processes, "find border");
    const DistributedMesh input = input_of(mesh);
    Border border{{}, sharing_of(input)};
    const std::vector<Interface> of_input = find_interfaces(input, border.sharing);
    SharingBuilder<VertexIndex> shared(border.sharing, mesh.processes.rank());
    for (BorderWith& with : border_after_steps(mesh, of_input)) {
        shared.share(with.interface.rank, std::move(with.midpoints));
        border.interfaces.push_back(std::move(with.interface));
    }
    shared.prepare([&](VertexIndex v) { return static_cast<std::uint64_t>(numbers.of_vertex[v]); });
    shared.commit();
    return border;
}

/// Replaces a state, whose mesh `order` has put into canonical order, by that after a migration.
/// Returns the migration.
Migration replace(AdaptiveMesh::State& state, CanonicalOrder& order, MovedState after,
                  std::unique_ptr<CellsAsRoots> roots) noexcept {
    order.keep();
    state.replace_by(std::move(*after.state), std::move(roots));
    return std::move(after.migration);
}

}  // namespace

MovedState moved_state(const AdaptiveMesh::State& state,
                       std::span<const CellIndex> unordered_cell_ids,
                       std::span<const int> rank_of_root) {
    const Communicator& processes = state.mesh.processes;
    std::vector<VertexDestination> destinations;
    MergedPart merged = move_roots(state, rank_of_root, destinations);
    MovedEntities moved = moved_entities({&state.mesh, rank_of_root, unordered_cell_ids},
                                         {&merged.mesh, merged.rank_of_root}, state.sharing,
                                         std::move(merged.kept_vertices));
    auto after = std::make_unique<AdaptiveMesh::State>();
    after->numbers = {moved_numbers(processes, moved, state.numbers.of_vertex),
                      state.numbers.vertex_count};
    after->mesh = std::move(merged.mesh);
    after->step_count = state.step_count;
    Border border = find_border(after->mesh, after->numbers, [&](const DistributedMesh& input) {
        return moved_sharing(input, state.sharing, state.mesh.input_vertices, destinations);
    });
    after->mesh.interfaces = std::move(border.interfaces);
    after->sharing = std::move(border.sharing);
    return {std::move(after), Migration(processes, std::move(moved.partners),
                                        std::move(moved.cells), std::move(moved.vertices))};
}

std::unique_ptr<AdaptiveMesh::State> state_of(DistributedMesh& mesh) {
    auto state = std::make_unique<AdaptiveMesh::State>();
    state->numbers =
        in_phase(mesh.processes, "number vertices", [&] { return canonical_numbers(mesh); });
    const auto sharing_of = [](const DistributedMesh& input) { return find_vertex_sharing(input); };
    state->sharing = find_border(mesh, state->numbers, sharing_of).sharing;
    state->step_count = static_cast<int>(mesh.level_begin.size());
    state->mesh = std::move(mesh);
    return state;
}

Migration migrate_state(AdaptiveMesh::State& state, std::span<const int> rank_of_root) {
    const StandardArithmetic standard;
    const Communicator& processes = state.mesh.processes;
    const Phase phase(processes, "migrate");
    std::optional<CanonicalOrder> order;
    MovedState after = processes.transaction([&]() -> MovedState {
        check_ranks(state.mesh, rank_of_root);
        const auto stays = [&](int rank) { return rank == processes.rank(); };
        if (processes.max(std::ranges::all_of(rank_of_root, stays) ? 0 : 1) == 0) {
            return {nullptr, unmoved(state.mesh)};
        }
        order.emplace(state.mesh);
        return moved_state(state, order->cells_before(), rank_of_root);
    });
    if (after.state == nullptr) return std::move(after.migration);
    return replace(state, *order, std::move(after), nullptr);
}

EvenMigration even_migration(AdaptiveMesh::State& state, const BalanceOptions& balance) {
    const Communicator& processes = state.mesh.processes;
    const auto count = static_cast<std::uint64_t>(state.mesh.cells.size());
    const auto mean =
        static_cast<double>(processes.sum(count)) / static_cast<double>(processes.size());
    if (static_cast<double>(processes.max(count)) <= balance.most_over_mean * mean) {
        return {nullptr, nullptr, {nullptr, unmoved(state.mesh)}};
    }
    EvenMigration even{std::make_unique<CanonicalOrder>(state.mesh), nullptr, {}};
    const auto weigh = [&] { return cells_of_roots(state.mesh); };
    BalanceOptions options = balance;
    options.may_forget_history =
        balance.may_forget_history && state.mesh.closure != Closure::regular;
    const auto ranks = even_parts_or_roots(state.mesh, weigh, options, even.roots, &state.numbers);
    if (!ranks) return {nullptr, nullptr, {nullptr, unmoved(state.mesh)}};
    const Phase phase(processes, "migrate");
    state.forgotten.reserve(state.forgotten.size() + 1);
    even.to = moved_state(state, even.order->cells_before(), *ranks);
    return even;
}

Migration EvenMigration::commit(AdaptiveMesh::State& state) noexcept {
    if (to.state == nullptr) return std::move(to.migration);
    return replace(state, *order, std::move(to), std::move(roots));
}

Migration rebalance_state(AdaptiveMesh::State& state, const BalanceOptions& options) {
    const StandardArithmetic standard;
    const Communicator& processes = state.mesh.processes;
    return processes
        .transaction([&] {
            check_same(processes, options);
            return even_migration(state, options);
        })
        .commit(state);
}

Migration recall_history(AdaptiveMesh::State& state) {
    const StandardArithmetic standard;
    if (state.forgotten.empty()) return unmoved(state.mesh);
    const Communicator& processes = state.mesh.processes;
    const Phase phase(processes, "recall history");
    std::optional<CanonicalOrder> order;
    MovedState after = processes.transaction([&] {
        const History& before = state.forgotten.back();
        order.emplace(state.mesh);
        const std::vector<int> ranks =
            ranks_of_roots(processes, before.cell_ancestors, state.mesh.cell_ancestors.roots);
        MovedState moved = moved_state(state, order->cells_before(), ranks);
        DistributedMesh& mesh = moved.state->mesh;
        move_tagged_to_history(mesh, moved.state->numbers.of_vertex, before);
        joined(before, mesh).swap_with(mesh);
        return moved;
    });
    state.forgotten.pop_back();
    return replace(state, *order, std::move(after), nullptr);
}

}  // namespace octetra::distributed
