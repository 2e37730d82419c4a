#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "regular/regular_step.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// Returns the map from the entities after a step to those before it.
EntityTransfer transfer_of(Descent descent, std::size_t count_before) {
    return EntityTransfer::of_parents(count_before, std::move(descent.before),
                                      std::move(descent.halvings));
}

}  // namespace

/// Returns the vertices that are shared with each rank after the step, by their new numbers.
std::vector<RegularStep::SharedVertices> RegularStep::shared_after() const {
    std::vector<SharedVertices> shared;
    for (const SharedWith<VertexIndex>& with : state_->sharing.neighbours()) {
        shared.push_back({with.rank, with.entities});
    }
    for (std::size_t i = 0; i < new_shared_.size(); ++i) {
        const int rank = mesh_->interfaces[i].rank;
        auto of_rank = std::ranges::lower_bound(shared, rank, {}, &SharedVertices::rank);
        if (of_rank == shared.end() || of_rank->rank != rank) {
            of_rank = shared.insert(of_rank, {rank, {}});
        }
        auto& vertices = of_rank->vertices;
        vertices.insert(vertices.end(), new_shared_[i].begin(), new_shared_[i].end());
    }
    for (SharedVertices& with : shared) {
        for (VertexIndex& v : with.vertices) v = order_->number_after(v);
        std::ranges::sort(with.vertices);
    }
    return shared;
}

/// Collective. Numbers the vertices from the first generation that has a new one, and determines
/// their owners.
void RegularStep::number_vertices(const std::vector<SharedVertices>& shared) {
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const Communicator& processes = mesh_->processes;
    const auto& generations = cells_.generations();
    std::uint64_t least = none;
    for (VertexIndex v = before_.end; v < generations.end_index(); ++v) {
        least = std::min<std::uint64_t>(least, generations[v]);
    }
    const std::size_t first_level = none - processes.max(none - least) - 1;

    const VertexIndex begin = order_->level_begin[first_level];
    const auto& before = state_->numbers.of_vertex;
    const std::uint64_t first_number =
        begin < before.end_index() ? static_cast<std::uint64_t>(before[begin]) : none;
    const std::uint64_t count_before = none - processes.max(none - first_number);
    numbers_.vertex_count = std::min(count_before, state_->numbers.vertex_count);
    numbers_.of_vertex.reserve(mesh_->points.size());
    numbers_.of_vertex.assign(before.begin(), before.begin() + begin.value());

    std::vector<VertexIndex> all_shared;
    for (const SharedVertices& with : shared) {
        all_shared.insert(all_shared.end(), with.vertices.begin(), with.vertices.end());
    }
    std::ranges::sort(all_shared);
    all_shared.erase(std::unique(all_shared.begin(), all_shared.end()), all_shared.end());
    for (std::size_t level = first_level; level < order_->level_begin.size(); ++level) {
        numbers_.number_midpoints(processes, order_->midpoint_ends(*mesh_, level), all_shared);
    }
    SharingBuilder<VertexIndex> builder(sharing_, processes.rank());
    for (const SharedVertices& with : shared) builder.share(with.rank, with.vertices);
    builder.prepare(
        [&](VertexIndex v) { return static_cast<std::uint64_t>(numbers_.of_vertex[v]); });
    builder.commit();
}

void RegularStep::describe() {
    const std::size_t count = mesh_->points.size();
    const std::size_t input_count = mesh_->input_vertices.size();
    adaptation_ = {.changed = true,
                   .cells = transfer_of(std::move(of_cells_), cell_count_before_),
                   .facets = transfer_of(std::move(of_facets_), facet_count_before_),
                   .edges = transfer_of(std::move(of_edges_), edge_count_before_),
                   .vertex_count_before = before_.end.value(),
                   .new_vertex_ends = {},
                   .vertices_before = {},
                   .removed_vertices = {},
                   .synchronisation = counts_};
    auto& vertices_before = adaptation_.vertices_before;
    vertices_before.resize(count, VertexIndex::none());
    for (VertexIndex v{0}; v < before_.end; ++v) {
        vertices_before[order_->number_after(v).value()] = v;
    }
    const std::vector<EdgeVertices>& ends =
        order_->is_changed ? order_->midpoint_to_edge : mesh_->midpoint_to_edge;
    for (std::size_t v = input_count; v < count; ++v) {
        if (!vertices_before[v].is_none()) continue;
        adaptation_.new_vertex_ends.push_back(ends[v - input_count]);
    }
}

Adaptation RegularStep::commit() noexcept {
    changes_.keep();
    order_->commit(*mesh_);
    mesh_->closure = Closure::regular;
    state_->numbers = std::move(numbers_);
    state_->sharing = std::move(sharing_);
    state_->transition_kinds = std::move(cells_.kinds());
    state_->step_count += static_cast<int>(mesh_->level_begin.size() - before_.level_begin.size());
    return std::move(adaptation_);
}

}  // namespace octetra::distributed
