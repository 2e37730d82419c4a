#include <octetra/distributed/levels.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "adapt/mesh_state.hpp"
#include "levels/level_data.hpp"
#include "numbering/ordered_lists.hpp"
#include "sharing/sharing_builder.hpp"

namespace octetra::distributed {
namespace {

/// Copies the lists and the history of a mesh, which determine all its levels.
void copy_finest(const DistributedMesh& mesh, Levels::Data& data) {
    const OrderedLists lists(mesh);
    DistributedMesh& finest = data.finest;
    finest.processes = mesh.processes;
    finest.points = mesh.points;
    finest.input_vertices = mesh.input_vertices;
    finest.level_begin = mesh.level_begin;
    finest.midpoint_to_edge = mesh.midpoint_to_edge;
    const auto copy = [](const auto& ordered, auto& list, AncestorMap& ancestors, auto& before) {
        list = ordered.list();
        ancestors = ordered.ancestors();
        before.assign(ordered.before().begin(), ordered.before().end());
    };
    copy(lists.cells, finest.cells, finest.cell_ancestors, data.cells_before);
    copy(lists.facets, finest.facets, finest.facet_ancestors, data.facets_before);
    copy(lists.edges, finest.edges, finest.edge_ancestors, data.edges_before);
}

/// Returns the number of this process's vertices after each step, from 0 on.
std::vector<std::size_t> local_counts(const DistributedMesh& mesh) {
    std::vector<std::size_t> counts;
    for (const VertexIndex begin : mesh.level_begin) counts.push_back(begin.value());
    counts.push_back(mesh.points.size());
    return counts;
}

/// Collective. Returns the number of vertices of the whole mesh after each step. Each step's
/// numbers follow those of the steps before.
std::vector<std::uint64_t> whole_counts(const AdaptiveMesh::State& state,
                                        std::span<const std::size_t> local) {
    std::vector<std::uint64_t> counts;
    for (const std::size_t end : local) {
        const auto last =
            end == 0 ? GlobalVertex{0} : state.numbers.of_vertex[VertexIndex{end - 1}];
        counts.push_back(end == 0 ? 0 : static_cast<std::uint64_t>(last) + 1);
    }
    state.mesh.processes.max(counts);
    return counts;
}

/// Returns the steps that make the levels, coarsest first, for these numbers of vertices after each
/// step.
std::vector<std::size_t> chosen_steps(std::span<const std::uint64_t> counts, double growth) {
    std::vector<std::size_t> steps{counts.size() - 1};
    for (std::size_t step = counts.size() - 1; step-- > 0;) {
        const auto finer = static_cast<double>(counts[steps.back()]);
        const bool is_coarse_enough = growth * static_cast<double>(counts[step]) <= finer;
        if (is_coarse_enough && counts[step] < counts[steps.back()]) steps.push_back(step);
    }
    if (steps.back() != 0) steps.push_back(0);
    std::ranges::reverse(steps);
    return steps;
}

/// Returns the sharing of the first `count` vertices.
Sharing<VertexIndex> first_of(const Sharing<VertexIndex>& sharing, std::size_t count,
                              std::span<const GlobalVertex> numbers) {
    Sharing<VertexIndex> first;
    SharingBuilder<VertexIndex> builder(first, sharing.rank());
    for (const SharedWith<VertexIndex>& with : sharing.neighbours()) {
        std::vector<VertexIndex> entities;
        for (const VertexIndex v : with.entities) {
            if (v.value() < count) entities.push_back(v);
        }
        builder.share(with.rank, std::move(entities));
    }
    builder.prepare([&](VertexIndex v) { return static_cast<std::uint64_t>(numbers[v.value()]); });
    builder.commit();
    return first;
}

void check_growth(double growth) {
    if (std::isfinite(growth) && growth >= 1) return;
    throw InputError(fmt::format("levels: growth is a finite number from 1 on, not {}", growth));
}

}  // namespace

Levels AdaptiveMesh::levels(const LevelOptions& options) const {
    return processes().transaction([&] {
        processes().check_same("growth", fmt::format("{}", options.growth));
        check_growth(options.growth);
        const auto local = local_counts(state_->mesh);
        const auto whole = whole_counts(*state_, local);
        const auto& numbers = state_->numbers.of_vertex;
        auto data = std::make_shared<Levels::Data>();
        copy_finest(state_->mesh, *data);
        data->vertex_numbers.assign(numbers.begin(), numbers.end());
        for (const std::size_t step : chosen_steps(whole, options.growth)) {
            data->levels.push_back(
                {step, whole[step], local[step], first_of(state_->sharing, local[step], numbers)});
        }
        return Levels(std::move(data));
    });
}

const Levels::Data::Level& Levels::Data::at(std::size_t level) const {
    if (level < levels.size()) return levels[level];
    throw InputError(
        fmt::format("level {}: the levels of the mesh are 0 to {}", level, levels.size() - 1));
}

std::size_t Levels::count() const { return data_->levels.size(); }
const Communicator& Levels::processes() const { return data_->finest.processes; }
std::size_t Levels::step(std::size_t level) const { return data_->at(level).step; }
std::uint64_t Levels::vertex_count(std::size_t level) const {
    return data_->at(level).vertex_count;
}
std::span<const Point> Levels::points(std::size_t level) const {
    return std::span(data_->finest.points).first(data_->at(level).vertices);
}
std::span<const GlobalVertex> Levels::vertex_numbers(std::size_t level) const {
    return std::span(data_->vertex_numbers).first(data_->at(level).vertices);
}
const Sharing<VertexIndex>& Levels::vertex_sharing(std::size_t level) const {
    return data_->at(level).sharing;
}

}  // namespace octetra::distributed
