#include "coarsen/coarser_part.hpp"

#include <algorithm>
#include <utility>

#include "coarsen/coarser_interfaces.hpp"
#include "coarsen/coarser_list.hpp"
#include "coarsen/family_division.hpp"
#include "comm/local_failure.hpp"
#include "history/vertex_levels.hpp"

namespace octetra::distributed {
namespace {

/// What has no other numbers afterwards.
DistributedMesh unchanged_parts(const DistributedMesh& mesh) {
    DistributedMesh after;
    after.processes = mesh.processes;
    after.attributes_per_point = mesh.attributes_per_point;
    after.input_vertices = mesh.input_vertices;
    after.input_vertex_markers = mesh.input_vertex_markers;
    after.input_vertex_count = mesh.input_vertex_count;
    after.input_cell_count = mesh.input_cell_count;
    after.index_base = mesh.index_base;
    after.group_names = mesh.group_names;
    return after;
}

/// The numbers that vertices have afterwards, or would have if they stayed.
IndexVector<VertexIndex, VertexIndex> numbers_after(const KeptVertices& kept) {
    IndexVector<VertexIndex, VertexIndex> after;
    after.reserve(kept.size() + 1);
    std::size_t next = 0;
    for (const std::uint8_t stays : kept) {
        after.push_back(VertexIndex{next});
        next += stays;
    }
    after.push_back(VertexIndex{next});
    return after;
}

void renumber(auto& list, const IndexVector<VertexIndex, VertexIndex>& after) {
    for (auto& vertices : list) {
        for (VertexIndex& v : vertices) v = after[v];
    }
}

/// Vertices, and what belongs to them.
void keep_vertices(const DistributedMesh& mesh, const std::vector<VertexIndex>& kept,
                   const IndexVector<VertexIndex, VertexIndex>& number_after,
                   DistributedMesh& after) {
    const std::size_t first_midpoint = mesh.input_vertices.size();
    const std::size_t attributes = mesh.attributes_per_point;
    after.points.reserve(kept.size());
    after.point_attributes.reserve(kept.size() * attributes);
    after.midpoint_to_edge.reserve(kept.size() - first_midpoint);
    for (const VertexIndex v : kept) {
        after.points.push_back(mesh.points[v]);
        const auto values =
            mesh.point_attributes.begin() + static_cast<std::ptrdiff_t>(v.value() * attributes);
        after.point_attributes.insert(after.point_attributes.end(), values,
                                      values + static_cast<std::ptrdiff_t>(attributes));
        if (v.value() < first_midpoint) continue;
        const std::size_t m = v.value() - first_midpoint;
        after.midpoint_to_edge.push_back(mesh.midpoint_to_edge[m]);
        if (!mesh.midpoint_markers.empty()) {
            after.midpoint_markers.push_back(mesh.midpoint_markers[m]);
        }
    }
    renumber(after.midpoint_to_edge, number_after);
    for (const VertexIndex begin : mesh.level_begin) {
        after.level_begin.push_back(number_after[begin]);
    }
}

std::vector<VertexIndex> list_of(const KeptVertices& kept, std::size_t count) {
    std::vector<VertexIndex> list;
    list.reserve(count);
    for (VertexIndex v{0}; v < kept.end_index(); ++v) {
        if (kept[v] != 0) list.push_back(v);
    }
    return list;
}

/// What is known of entities in canonical order, by the numbers that they had.
template <class T, class I>
std::vector<T> by_number(std::vector<T> ordered, const std::vector<I>& before) {
    if (before.empty()) return ordered;
    std::vector<T> values(ordered.size());
    for (std::size_t k = 0; k < before.size(); ++k) values[before[k].value()] = ordered[k];
    return values;
}

}  // namespace

CoarserPart coarser_vertices(const DistributedMesh& mesh, const KeptVertices& kept) {
    CoarserPart part;
    part.mesh = unchanged_parts(mesh);
    part.first_gone =
        VertexIndex{static_cast<std::size_t>(std::ranges::find(kept, 0) - kept.begin())};
    part.vertex_after = numbers_after(kept);
    part.vertices_before = list_of(kept, part.vertex_after.back().value());
    keep_vertices(mesh, part.vertices_before, part.vertex_after, part.mesh);
    part.mesh.interfaces = coarser_interfaces(mesh.interfaces, VertexLevels(mesh), kept);
    for (Interface& interface : part.mesh.interfaces) {
        renumber(interface.edges, part.vertex_after);
        renumber(interface.faces, part.vertex_after);
    }
    return part;
}

void coarsen_lists(const DistributedMesh& mesh, const CanonicalOrder& order,
                   const KeptVertices& kept, CoarserPart& part) {
    const VertexLevels levels(mesh);
    const auto take = [&](auto coarser, auto& list, AncestorMap& ancestors, const AncestorMap& of,
                          const auto& before) {
        list = std::move(coarser.list);
        renumber(list, part.vertex_after);
        ancestors = {of.roots, std::move(coarser.first), of.markers};
        return Succession::of_merges(list.size(), by_number(std::move(coarser.whole_of), before),
                                     by_number(std::move(coarser.halvings), before));
    };
    FamilyDivision divide(mesh, levels.count());
    DistributedMesh& after = part.mesh;
    part.cells = take(ListCoarsening<CellIndex, 4>(levels, kept).run(mesh.cells, divide),
                      after.cells, after.cell_ancestors, mesh.cell_ancestors, order.cells_before());
    part.facets =
        take(ListCoarsening<FacetIndex, 3>(levels, kept).run(mesh.facets, divide), after.facets,
             after.facet_ancestors, mesh.facet_ancestors, order.facets_before());
    part.edges = take(ListCoarsening<EdgeIndex, 2>(levels, kept).run(mesh.edges, divide),
                      after.edges, after.edge_ancestors, mesh.edge_ancestors, order.edges_before());
    part.failures = std::move(divide).failures();
}

void drop_empty_levels(CoarserPart& part) {
    const Communicator& processes = part.mesh.processes;
    LocalFailure failure;
    std::vector<std::uint64_t> has_any;
    auto& begins = part.mesh.level_begin;
    failure.attempt([&] {
        for (std::size_t t = 0; t < begins.size(); ++t) {
            const VertexIndex end =
                t + 1 < begins.size() ? begins[t + 1] : part.mesh.points.end_index();
            has_any.push_back(begins[t] < end ? 1 : 0);
        }
    });
    failure.agree(processes);
    processes.max(has_any);
    const bool any_failed =
        processes.max(std::ranges::any_of(part.failures, &RoundingFailure::found) ? 1 : 0) != 0;
    std::size_t left = 0;
    for (std::size_t t = 0; t < begins.size(); ++t) {
        if (has_any[t] == 0) continue;
        begins[left++] = begins[t];
        if (any_failed) part.failures[t].agree(part.mesh, static_cast<int>(left));
    }
    begins.resize(left);
}

}  // namespace octetra::distributed
