#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "canonical_numbers.hpp"

namespace octetra::distributed {
namespace {

/// What one process knows of a vertex, on the way to the first.
struct VertexRecord {
    std::uint64_t number = 0;
    Point point;
    std::uint64_t low_end = 0;  // of the midpoint's edge
    std::uint64_t high_end = 0;
    Marker marker = 0;
    MidpointMarker::Source source = MidpointMarker::Source::nothing;
};

std::vector<VertexRecord> vertex_records(const DistributedMesh& mesh,
                                         const CanonicalNumbers& numbers) {
    std::vector<VertexRecord> records;
    records.reserve(mesh.points.size());
    const auto number = [&](VertexIndex v) {
        return static_cast<std::uint64_t>(numbers.of_vertex[v]);
    };
    const std::size_t input_count = mesh.input_vertices.size();
    for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
        VertexRecord& record = records.emplace_back();
        record.number = number(v);
        record.point = mesh.points[v];
        if (v.value() < input_count) {
            if (!mesh.input_vertex_markers.empty()) {
                record.marker = mesh.input_vertex_markers[v.value()];
            }
            continue;
        }
        const std::size_t m = v.value() - input_count;
        record.low_end = number(mesh.midpoint_to_edge[m][0]);
        record.high_end = number(mesh.midpoint_to_edge[m][1]);
        if (!mesh.midpoint_markers.empty()) {
            record.marker = mesh.midpoint_markers[m].marker;
            record.source = mesh.midpoint_markers[m].source;
        }
    }
    return records;
}

/// Processes that share an edge may know of different facets around it. A listed edge tells more
/// than a facet, a facet more than nothing; among equals the smallest marker counts.
bool tells_more(const VertexRecord& a, const VertexRecord& b) {
    if (a.source != b.source) return a.source > b.source;
    return a.marker < b.marker;
}

void place_vertices(const std::vector<std::vector<VertexRecord>>& from_each,
                    const DistributedMesh& part, std::uint64_t vertex_count, bool has_markers,
                    Collected& whole) {
    const std::uint64_t input_count = part.input_vertex_count;
    whole.mesh.points.resize(vertex_count);
    whole.maps.midpoint_to_edge.resize(vertex_count - input_count);
    std::vector<VertexRecord> told(has_markers ? vertex_count : 0);
    std::vector<bool> met(told.size(), false);
    for (const auto& records : from_each) {
        for (const VertexRecord& record : records) {
            whole.mesh.points[VertexIndex{record.number}] = record.point;
            if (record.number >= input_count) {
                whole.maps.midpoint_to_edge[record.number - input_count] = {
                    VertexIndex{record.low_end}, VertexIndex{record.high_end}};
            }
            if (!has_markers) continue;
            if (!met[record.number] || tells_more(record, told[record.number])) {
                told[record.number] = record;
            }
            met[record.number] = true;
        }
    }
    for (const VertexRecord& record : told) whole.mesh.point_markers.push_back(record.marker);
}

void place_attributes(const std::vector<std::vector<VertexRecord>>& records,
                      const std::vector<std::vector<double>>& attributes, std::size_t per_point,
                      Mesh& mesh) {
    mesh.attributes_per_point = per_point;
    mesh.point_attributes.resize(per_point * mesh.points.size());
    for (std::size_t r = 0; r < records.size(); ++r) {
        for (std::size_t v = 0; v < records[r].size(); ++v) {
            std::copy_n(attributes[r].begin() + static_cast<std::ptrdiff_t>(v * per_point),
                        per_point,
                        mesh.point_attributes.begin() +
                            static_cast<std::ptrdiff_t>(records[r][v].number * per_point));
        }
    }
}

/// Collective. The first process gets all entities of a kind in canonical order, and for each its
/// root in the input.
template <class I, std::size_t N>
void collect_entities(const DistributedMesh& part, const CanonicalNumbers& numbers,
                      const IndexVector<I, std::array<VertexIndex, N>>& entities,
                      const Lineage& lineage, IndexVector<I, std::array<VertexIndex, N>>& all,
                      IndexVector<I, Marker>& all_markers, IndexVector<I, I>& all_roots) {
    struct Root {
        std::uint64_t number;
        std::uint64_t count;
        Marker marker;
    };
    std::vector<Root> roots;
    for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
        roots.push_back({lineage.roots[r], lineage.first[r + 1] - lineage.first[r],
                         lineage.markers.empty() ? 0 : lineage.markers[r]});
    }
    IndexVector<I, std::array<VertexIndex, N>> renumbered = entities;
    for (auto& vertices : renumbered) {
        for (VertexIndex& v : vertices) {
            v = VertexIndex{static_cast<std::uint64_t>(numbers.of_vertex[v])};
        }
    }
    const Communicator& processes = part.processes;
    const bool has_markers = processes.max(lineage.markers.empty() ? 0 : 1) == 1;
    const auto roots_of_each = processes.gather(roots);
    const auto entities_of_each = processes.gather<std::array<VertexIndex, N>>(renumbered);
    if (!processes.is_first()) return;

    struct Run {  // the descendants of one root, somewhere in what a process sent
        Root root;
        std::size_t rank;
        std::size_t first;
    };
    std::vector<Run> runs;
    std::size_t total = 0;
    for (std::size_t rank = 0; rank < roots_of_each.size(); ++rank) {
        std::size_t first = 0;
        for (const Root& root : roots_of_each[rank]) {
            runs.push_back({root, rank, first});
            first += root.count;
        }
        total += first;
    }
    std::ranges::sort(runs, {}, [](const Run& run) { return run.root.number; });
    all.reserve(total);
    all_roots.reserve(total);
    for (const Run& run : runs) {
        const auto begin =
            entities_of_each[run.rank].begin() + static_cast<std::ptrdiff_t>(run.first);
        all.insert(all.end(), begin, begin + static_cast<std::ptrdiff_t>(run.root.count));
        all_roots.insert(all_roots.end(), run.root.count, I{run.root.number});
        if (has_markers) all_markers.insert(all_markers.end(), run.root.count, run.root.marker);
    }
}

void check_countable(const DistributedMesh& mesh, const CanonicalNumbers& numbers) {
    const std::uint64_t most =
        std::max({numbers.vertex_count, mesh.processes.sum(mesh.cells.size()),
                  mesh.processes.sum(mesh.facets.size()), mesh.processes.sum(mesh.edges.size())});
    if (most < VertexIndex::limit) return;
    throw InputError(
        fmt::format("the refined mesh is too large for one file of one process: {} "
                    "entities of a kind, and at most {} can be numbered",
                    most, VertexIndex::limit));
}

/// The markers of a process's own vertices, when it has all of them.
IndexVector<VertexIndex, Marker> own_markers(const DistributedMesh& part) {
    IndexVector<VertexIndex, Marker> markers;
    markers.assign(part.input_vertex_markers.begin(), part.input_vertex_markers.end());
    for (const MidpointMarker& m : part.midpoint_markers) markers.push_back(m.marker);
    return markers;
}

template <class I>
void expand(const Lineage& lineage, IndexVector<I, Marker>& markers, IndexVector<I, I>* roots) {
    for (std::size_t r = 0; r < lineage.roots.size(); ++r) {
        const std::size_t count = lineage.first[r + 1] - lineage.first[r];
        if (!lineage.markers.empty()) markers.insert(markers.end(), count, lineage.markers[r]);
        if (roots != nullptr) roots->insert(roots->end(), count, I{lineage.roots[r]});
    }
}

/// One process's vertices, cells and lists are in canonical order as they are.
Collected hand_over(DistributedMesh part) {
    Collected whole;
    Mesh& mesh = whole.mesh;
    mesh.point_markers = own_markers(part);
    mesh.attributes_per_point = part.attributes_per_point;
    mesh.point_attributes = std::move(part.point_attributes);
    whole.maps.cell_to_parent.reserve(part.cells.size());
    expand(part.cell_lineage, mesh.regions, &whole.maps.cell_to_parent);
    expand<FacetIndex>(part.facet_lineage, mesh.facet_markers, nullptr);
    expand<EdgeIndex>(part.edge_lineage, mesh.edge_markers, nullptr);
    mesh.points = std::move(part.points);
    mesh.cells = std::move(part.cells);
    mesh.facets = std::move(part.facets);
    mesh.edges = std::move(part.edges);
    whole.maps.midpoint_to_edge = std::move(part.midpoint_to_edge);
    return whole;
}

Collected gather(const DistributedMesh& part) {
    const CanonicalNumbers numbers = canonical_numbers(part);
    check_countable(part, numbers);
    Collected whole;
    Mesh& mesh = whole.mesh;
    const Communicator& processes = part.processes;
    const bool has_markers = processes.max(part.input_vertex_markers.empty() ? 0 : 1) == 1;
    const auto records = processes.gather(vertex_records(part, numbers));
    const auto attributes = processes.gather(part.point_attributes);
    if (processes.is_first()) {
        place_vertices(records, part, numbers.vertex_count, has_markers, whole);
        place_attributes(records, attributes, part.attributes_per_point, mesh);
    }
    collect_entities(part, numbers, part.cells, part.cell_lineage, mesh.cells, mesh.regions,
                     whole.maps.cell_to_parent);
    IndexVector<FacetIndex, FacetIndex> facet_roots;
    collect_entities(part, numbers, part.facets, part.facet_lineage, mesh.facets,
                     mesh.facet_markers, facet_roots);
    IndexVector<EdgeIndex, EdgeIndex> edge_roots;
    collect_entities(part, numbers, part.edges, part.edge_lineage, mesh.edges, mesh.edge_markers,
                     edge_roots);
    return whole;
}

}  // namespace

Collected collect(DistributedMesh mesh) {
    const Communicator processes = mesh.processes;  // the mesh may be gone before the phase ends
    const Phase phase(processes, "collect");
    const std::uint32_t first_number = mesh.first_number;
    const VertexIndex first_midpoint{mesh.input_vertex_count};
    Collected whole = mesh.processes.size() == 1 ? hand_over(std::move(mesh)) : gather(mesh);
    whole.mesh.first_number = first_number;
    whole.maps.first_number = first_number;
    whole.maps.first_midpoint = first_midpoint;
    return whole;
}

}  // namespace octetra::distributed
