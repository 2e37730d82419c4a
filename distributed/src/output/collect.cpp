#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "output/canonical_slices.hpp"

namespace octetra::distributed {
namespace {

/// Returns the markers of the vertices of the only process.
IndexVector<VertexIndex, Marker> own_markers(const DistributedMesh& part) {
    IndexVector<VertexIndex, Marker> markers;
    markers.assign(part.input_vertex_markers.begin(), part.input_vertex_markers.end());
    for (const MidpointMarker& m : part.midpoint_markers) markers.push_back(m.marker);
    return markers;
}

template <class I>
void expand(const AncestorMap& ancestors, IndexVector<I, Marker>& markers,
            IndexVector<I, I>* roots) {
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        const std::size_t count = ancestors.first[r + 1] - ancestors.first[r];
        if (!ancestors.markers.empty()) markers.insert(markers.end(), count, ancestors.markers[r]);
        if (roots != nullptr) roots->insert(roots->end(), count, I{ancestors.roots[r]});
    }
}

/// Returns the features of the only process.
FeatureLists own_features(const DistributedMesh& part) {
    FeatureLists lists;
    if (!part.features) return lists;
    const CanonicalRuns edges = canonical_runs(part.processes, part.edge_ancestors);
    const CanonicalRuns facets = canonical_runs(part.processes, part.facet_ancestors);
    const CanonicalRuns cells = canonical_runs(part.processes, part.cell_ancestors);
    FeatureSlices slices(part, {{{&part.edge_ancestors, &edges},
                                 {&part.facet_ancestors, &facets},
                                 {&part.cell_ancestors, &cells}}});
    for (const Feature f : all_features) {
        const auto numbers = slices.slice(f, whole_window(slices.counts()[f]));
        lists[f].assign(numbers.begin(), numbers.end());
    }
    return lists;
}

/// Converts the part of the only process, whose lists are in canonical order, without copying them.
Collected hand_over(DistributedMesh part) {
    Collected whole;
    Mesh& mesh = whole.mesh;
    mesh.point_markers = own_markers(part);
    mesh.features = own_features(part);
    mesh.attributes_per_point = part.attributes_per_point;
    mesh.point_attributes = std::move(part.point_attributes);
    whole.maps.cell_to_parent.reserve(part.cells.size());
    expand(part.cell_ancestors, mesh.regions, &whole.maps.cell_to_parent);
    expand<FacetIndex>(part.facet_ancestors, mesh.facet_markers, nullptr);
    expand<EdgeIndex>(part.edge_ancestors, mesh.edge_markers, nullptr);
    mesh.points = std::move(part.points);
    mesh.cells = std::move(part.cells);
    mesh.facets = std::move(part.facets);
    mesh.edges = std::move(part.edges);
    whole.maps.midpoint_to_edge = std::move(part.midpoint_to_edge);
    return whole;
}

/// Throws InputError on all processes if one of the counts exceeds the range of 32-bit indices.
void check_countable(const MeshFacts& facts) {
    const std::uint64_t most = std::max({facts.vertices, facts.cells, facts.facets, facts.edges});
    if (most < VertexIndex::limit) return;
    throw InputError(
        fmt::format("the mesh is too large for one process: {} entities of a kind, and at most {} "
                    "are possible",
                    most, VertexIndex::limit));
}

/// Appends all `count` entities to the first process's list, one window at a time to limit the
/// memory of messages.
void fetch(auto& list, std::uint64_t count, std::size_t per_entity, auto&& slice_of) {
    constexpr std::uint64_t length = 1U << 18U;
    for (std::uint64_t begin = 0; begin < count; begin += length) {
        const auto slice = slice_of(Window{begin, length, std::min(count, begin + length)});
        if (begin == 0 && !slice.empty()) list.reserve(count * per_entity);
        for (const auto& value : slice) {
            if constexpr (requires { indices_of(value); }) {
                list.push_back(indices_of(value));
            } else {
                list.emplace_back(value);
            }
        }
    }
}

Collected gather(const DistributedMesh& part) {
    CanonicalSlices slices(part);
    const MeshFacts& facts = slices.facts();
    check_countable(facts);
    Collected whole;
    Mesh& mesh = whole.mesh;
    const auto all = [&](auto& list, std::uint64_t count, auto slice, std::size_t per_entity = 1) {
        fetch(list, count, per_entity,
              [&](const Window& window) { return (slices.*slice)(window); });
    };
    if (part.processes.is_first()) mesh.attributes_per_point = facts.attributes_per_point;
    using Slices = CanonicalSlices;
    all(mesh.points, facts.vertices, &Slices::points);
    if (facts.has_point_markers) all(mesh.point_markers, facts.vertices, &Slices::point_markers);
    if (facts.attributes_per_point > 0) {
        all(mesh.point_attributes, facts.vertices, &Slices::point_attributes,
            facts.attributes_per_point);
    }
    all(mesh.cells, facts.cells, &Slices::cells);
    if (facts.has_regions) all(mesh.regions, facts.cells, &Slices::regions);
    all(mesh.facets, facts.facets, &Slices::facets);
    if (facts.has_facet_markers) all(mesh.facet_markers, facts.facets, &Slices::facet_markers);
    all(mesh.edges, facts.edges, &Slices::edges);
    if (facts.has_edge_markers) all(mesh.edge_markers, facts.edges, &Slices::edge_markers);
    for (const Feature f : all_features) {
        fetch(mesh.features[f], facts.features[f], 1,
              [&](const Window& window) { return slices.features(f, window); });
    }
    all(whole.maps.cell_to_parent, facts.cells, &Slices::parents);
    all(whole.maps.midpoint_to_edge, facts.vertices - facts.first_midpoint, &Slices::midpoint_ends);
    return whole;
}

}  // namespace

Collected collect(DistributedMesh mesh) {
    // the mesh may be destroyed before the phase ends
    const Communicator processes = mesh.processes;
    if (processes.size() > 1) return collect_copy(mesh);
    const Phase phase(processes, "collect");
    restore_canonical_order(mesh);
    const std::uint32_t index_base = mesh.index_base;
    const SharedGroupNames group_names = mesh.group_names;
    const VertexIndex first_midpoint{mesh.input_vertex_count};
    Collected whole = hand_over(std::move(mesh));
    whole.mesh.index_base = index_base;
    whole.mesh.group_names = group_names.list();
    whole.maps.first_midpoint = first_midpoint;
    return whole;
}

Collected collect_copy(const DistributedMesh& mesh) {
    return mesh.processes.transaction([&] {
        const Phase phase(mesh.processes, "collect");
        Collected whole = gather(mesh);
        whole.mesh.index_base = mesh.index_base;
        if (mesh.processes.is_first()) whole.mesh.group_names = mesh.group_names.list();
        whole.maps.first_midpoint = VertexIndex{mesh.input_vertex_count};
        return whole;
    });
}

}  // namespace octetra::distributed
