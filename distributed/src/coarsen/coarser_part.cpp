#include "coarsen/coarser_part.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <octetra/core/huge_pages.hpp>

#include "coarsen/coarser_interfaces.hpp"
#include "coarsen/coarser_list.hpp"
#include "coarsen/family_division.hpp"
#include "coarsen/level_removals.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

/// Returns the number of each vertex after coarsening; for a removed vertex, the number that it
/// would have if it were kept.
IndexVector<VertexIndex, VertexIndex> numbers_after(const KeptVertices& kept) {
    IndexVector<VertexIndex, VertexIndex> after;
    reserve_in_huge_pages(after, kept.size() + 1);
    after.resize(kept.size() + 1);
    std::size_t next = 0;
    for (VertexIndex v{0}; v < kept.end_index(); ++v) {
        after[v] = VertexIndex{next};
        next += kept[v];
    }
    after.back() = VertexIndex{next};
    return after;
}

void renumber(auto&& list, const IndexVector<VertexIndex, VertexIndex>& after) {
    for (auto& vertices : list) {
        for (VertexIndex& v : vertices) v = after[v];
    }
}

std::vector<VertexIndex> list_of(const KeptVertices& kept, std::size_t count) {
    std::vector<VertexIndex> list;
    reserve_in_huge_pages(list, count + 1);
    list.resize(count + 1);
    std::size_t next = 0;
    for (VertexIndex v{0}; v < kept.end_index(); ++v) {
        list[next] = v;  // overwritten by the next vertex if v is removed
        next += kept[v];
    }
    list.resize(count);
    return list;
}

/// Converts values in canonical order to the order of the previous numbers.
template <class T, class I>
std::vector<T> by_number(std::vector<T> ordered, const std::vector<I>& before) {
    if (before.empty()) return ordered;
    std::vector<T> values(ordered.size());
    for (std::size_t k = 0; k < before.size(); ++k) values[before[k].value()] = ordered[k];
    return values;
}

/// Moves the values of the remaining entities, `width` for each, whose previous numbers are
/// `before`. Entities before `first` are unchanged.
void compact_values(auto& list, std::span<const VertexIndex> before, std::size_t first,
                    std::size_t width) noexcept {
    if (list.empty()) return;
    for (std::size_t i = first; i < before.size(); ++i) {
        const auto from = list.begin() + static_cast<std::ptrdiff_t>(before[i].value() * width);
        std::copy_n(from, width, list.begin() + static_cast<std::ptrdiff_t>(i * width));
    }
    list.resize(before.size() * width);
    if (list.size() < list.capacity() / 2) list.shrink_to_fit();
}

/// The same for midpoints, whose lists omit the first `skipped` vertices.
void keep_midpoints(auto& list, std::span<const VertexIndex> before, std::size_t first,
                    std::size_t skipped) noexcept {
    if (list.empty()) return;
    for (std::size_t i = first; i < before.size(); ++i) {
        list[i - skipped] = list[before[i].value() - skipped];
    }
    list.resize(before.size() - skipped);
    if (list.size() < list.capacity() / 2) list.shrink_to_fit();
}

}  // namespace

CoarserPart coarser_vertices(const DistributedMesh& mesh, const KeptVertices& kept) {
    CoarserPart part;
    part.first_removed =
        VertexIndex{static_cast<std::size_t>(std::ranges::find(kept, 0) - kept.begin())};
    part.vertex_after = numbers_after(kept);
    part.vertices_before = list_of(kept, part.vertex_after.back().value());
    for (const VertexIndex begin : mesh.level_begin) {
        part.level_begin.push_back(part.vertex_after[begin]);
    }
    part.interfaces = coarser_interfaces(mesh.interfaces, VertexLevels(mesh), kept);
    for (Interface& interface : part.interfaces) {
        renumber(interface.edges, part.vertex_after);
        renumber(interface.faces, part.vertex_after);
    }
    return part;
}

void coarsen_lists(const DistributedMesh& mesh, const CanonicalOrder& order,
                   const KeptVertices& kept, CoarserPart& part) {
    const VertexLevels levels(mesh);
    const LevelRemovals removals(levels, kept);
    FamilyDivision divide(mesh, levels.count());
    const auto take = [&]<class I, std::size_t N>(
                          const IndexVector<I, std::array<VertexIndex, N>>& list,
                          const std::vector<I>& before, NewList<I, N>& after) {
        CoarserList<I, N> made = ListCoarsening<I, N>(levels, removals, kept).run(list, divide);
        after = {std::move(made.list), std::move(made.first)};
        renumber(after.list, part.vertex_after);
        return EntityTransfer::of_merges(after.list.size(),
                                         by_number(std::move(made.coarse_of), before),
                                         by_number(std::move(made.halvings), before));
    };
    part.cells = take(mesh.cells, order.cells_before(), part.new_cells);
    part.facets = take(mesh.facets, order.facets_before(), part.new_facets);
    part.edges = take(mesh.edges, order.edges_before(), part.new_edges);
    part.failures = std::move(divide).failures();
}

void drop_empty_levels(const DistributedMesh& mesh, CoarserPart& part) {
    const Communicator& processes = mesh.processes;
    std::vector<std::uint64_t> has_any;
    auto& begins = part.level_begin;
    for (std::size_t t = 0; t < begins.size(); ++t) {
        const VertexIndex end = t + 1 < begins.size() ? begins[t + 1] : part.vertex_after.back();
        has_any.push_back(begins[t] < end ? 1 : 0);
    }
    processes.max(has_any);
    const bool any_failed =
        processes.max(std::ranges::any_of(part.failures, &RoundingFailure::found) ? 1 : 0) != 0;
    std::size_t left = 0;
    for (std::size_t t = 0; t < begins.size(); ++t) {
        if (has_any[t] == 0) continue;
        begins[left++] = begins[t];
        if (any_failed) part.failures[t].agree(mesh, static_cast<int>(left));
    }
    begins.resize(left);
}

void commit_vertices(DistributedMesh& mesh, CoarserPart& part) noexcept {
    const std::span<const VertexIndex> before = part.vertices_before;
    const std::size_t first = part.first_removed.value();
    const std::size_t inputs = mesh.input_vertices.size();
    compact_values(mesh.points, before, first, 1);
    compact_values(mesh.point_attributes, before, first, mesh.attributes_per_point);
    keep_midpoints(mesh.midpoint_to_edge, before, first, inputs);
    keep_midpoints(mesh.midpoint_markers, before, first, inputs);
    if (first < before.size()) {
        renumber(std::span(mesh.midpoint_to_edge).subspan(first - inputs), part.vertex_after);
    }
    mesh.level_begin = std::move(part.level_begin);
    mesh.interfaces = std::move(part.interfaces);
}

void commit_new_lists(DistributedMesh& mesh, CoarserPart& part) noexcept {
    const auto take = [](auto& list, AncestorMap& ancestors, auto& made) {
        list = std::move(made.list);
        ancestors.first = std::move(made.first);
    };
    take(mesh.cells, mesh.cell_ancestors, part.new_cells);
    take(mesh.facets, mesh.facet_ancestors, part.new_facets);
    take(mesh.edges, mesh.edge_ancestors, part.new_edges);
}

}  // namespace octetra::distributed
