#include "history/part_history.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace octetra::distributed {
namespace {

/// Ancestors of which each is its own and only descendant.
AncestorMap undivided(const AncestorMap& ancestors) {
    AncestorMap roots{.roots = ancestors.roots, .first = {}, .markers = ancestors.markers};
    roots.first.resize(roots.roots.size() + 1);
    std::iota(roots.first.begin(), roots.first.end(), 0U);
    return roots;
}

/// Cuts of some of `cell_count` cells, by place.
CutRuns runs_of(std::vector<ListedCut> cuts, std::size_t cell_count) {
    std::ranges::sort(cuts, {}, &ListedCut::cell);
    CutRuns runs;
    CellIndex next{0};
    for (const auto& [cell, cut] : cuts) {
        runs.append(0, cell.value() - next.value());
        runs.append(cut);
        next = CellIndex{cell.value() + std::size_t{1}};
    }
    runs.append(0, cell_count - next.value());
    runs.finish();
    return runs;
}

}  // namespace

PartHistory::PartHistory(const DistributedMesh& input, std::vector<CutRuns> steps)
    : cells_(input.cells),
      facets_(input.facets),
      edges_(input.edges),
      interfaces_(input.interfaces),
      steps_(std::move(steps)) {}

PartHistory::NewStep PartHistory::prepare(std::size_t cell_count, CutCells cuts,
                                          bool restores_order,
                                          const std::vector<CellIndex>& before) {
    NewStep step{cell_count, std::move(cuts), restores_order, {}};
    if (restores_order) step.ordered = in_order(before);
    steps_.reserve(steps_.size() + step.ordered.size() + 1);
    listed_.reserve(listed_.size() + 1);
    return step;
}

void PartHistory::commit(NewStep step) noexcept {
    if (step.restores_order) {
        std::ranges::move(step.ordered, std::back_inserter(steps_));
        listed_.clear();
    }
    if (step.cuts.is_ordered) {
        steps_.push_back(std::move(step.cuts.runs));
    } else {
        listed_.push_back({step.cell_count, std::move(step.cuts.listed)});
    }
}

std::vector<CutRuns> PartHistory::steps(const std::vector<CellIndex>& before) const {
    std::vector<CutRuns> all = steps_;
    std::ranges::move(in_order(before), std::back_inserter(all));
    return all;
}

// The first piece of a cell has its number still and the others stand behind it. So the cells that
// there were before a step, those with lower numbers than what it added, stood in the order in
// which they, or their first pieces, stand now.
std::vector<CutRuns> PartHistory::in_order(const std::vector<CellIndex>& before) const {
    std::vector<CutRuns> steps(listed_.size());
    IndexVector<CellIndex, std::uint32_t> place(before.size());
    for (std::size_t p = 0; p < before.size(); ++p) {
        place[before[p]] = static_cast<std::uint32_t>(p);
    }
    std::vector<std::uint32_t> later;  // places of the cells that are yet to come, ascending
    std::size_t end = before.size();
    for (std::size_t t = listed_.size(); t-- > 0;) {
        const ListedStep& step = listed_[t];
        const auto known = static_cast<std::ptrdiff_t>(later.size());
        for (; end > step.cell_count; --end) later.push_back(place[CellIndex{end - 1}]);
        std::sort(later.begin() + known, later.end());
        std::inplace_merge(later.begin(), later.begin() + known, later.end());
        std::vector<ListedCut> cuts = step.cuts;
        for (auto& [cell, cut] : cuts) {
            const auto passed = std::ranges::lower_bound(later, place[cell]) - later.begin();
            cell = CellIndex{place[cell] - static_cast<std::size_t>(passed)};
        }
        steps[t] = runs_of(std::move(cuts), step.cell_count);
    }
    return steps;
}

DistributedMesh PartHistory::input_of(const DistributedMesh& mesh) const {
    const auto vertex_count = static_cast<std::ptrdiff_t>(mesh.input_vertices.size());
    const auto attribute_count =
        vertex_count * static_cast<std::ptrdiff_t>(mesh.attributes_per_point);
    DistributedMesh input;
    input.processes = mesh.processes;
    input.points.assign(mesh.points.begin(), mesh.points.begin() + vertex_count);
    input.attributes_per_point = mesh.attributes_per_point;
    input.point_attributes.assign(mesh.point_attributes.begin(),
                                  mesh.point_attributes.begin() + attribute_count);
    input.input_vertices = mesh.input_vertices;
    input.input_vertex_markers = mesh.input_vertex_markers;
    input.cells = cells_;
    input.cell_ancestors = undivided(mesh.cell_ancestors);
    input.facets = facets_;
    input.facet_ancestors = undivided(mesh.facet_ancestors);
    input.edges = edges_;
    input.edge_ancestors = undivided(mesh.edge_ancestors);
    input.interfaces = interfaces_;
    input.input_vertex_count = mesh.input_vertex_count;
    input.input_cell_count = mesh.input_cell_count;
    input.index_base = mesh.index_base;
    return input;
}

}  // namespace octetra::distributed
