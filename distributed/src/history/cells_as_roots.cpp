#include "history/cells_as_roots.hpp"

#include <numeric>
#include <utility>

#include "level/known_marker.hpp"
#include "numbering/canonical_runs.hpp"
#include "output/feature_slices.hpp"

namespace octetra::distributed {
namespace {

/// Returns the ancestors of a mesh in which every entity is its own root, numbered by `runs`.
AncestorMap own_roots(const AncestorMap& ancestors, const CanonicalRuns& runs) {
    AncestorMap own;
    own.roots.reserve(ancestors.first.back());
    if (!ancestors.markers.empty()) own.markers.reserve(ancestors.first.back());
    for (std::size_t r = 0; r < ancestors.roots.size(); ++r) {
        const std::size_t count = ancestors.first[r + 1] - ancestors.first[r];
        for (std::size_t k = 0; k < count; ++k) own.roots.push_back(runs.begin[r] + k);
        if (!ancestors.markers.empty()) {
            own.markers.insert(own.markers.end(), count, ancestors.markers[r]);
        }
    }
    own.first.resize(own.roots.size() + 1);
    std::iota(own.first.begin(), own.first.end(), 0U);
    return own;
}

/// Collective. Returns the markers of this process's vertices, agreed on by all sharers: a shared
/// midpoint is an end of a shared edge, so the interfaces reach it.
std::vector<Marker> agreed_markers(const DistributedMesh& mesh) {
    std::vector<MidpointMarker> known;
    const bool has_markers = !mesh.input_vertex_markers.empty() || !mesh.midpoint_markers.empty();
    if (has_markers) {
        for (VertexIndex v{0}; v < mesh.points.end_index(); ++v) {
            known.push_back(known_marker(mesh, v));
        }
    }
    std::vector<int> neighbours;
    std::vector<std::vector<MidpointMarker>> outboxes;
    for (const Interface& interface : mesh.interfaces) {
        neighbours.push_back(interface.rank);
        auto& outbox = outboxes.emplace_back();
        if (!has_markers) continue;
        for (const EdgeVertices& edge : interface.edges) {
            for (const VertexIndex v : edge) outbox.push_back(known[v.value()]);
        }
    }
    const auto inboxes = mesh.processes.exchange_with(neighbours, std::as_const(outboxes));
    for (std::size_t i = 0; i < inboxes.size(); ++i) {
        auto received = inboxes[i].begin();
        for (const EdgeVertices& edge : mesh.interfaces[i].edges) {
            for (const VertexIndex v : edge) {
                if (received == inboxes[i].end()) break;
                MidpointMarker& marker = known[v.value()];
                if (has_priority_over(*received, marker)) marker = *received;
                ++received;
            }
        }
    }
    std::vector<Marker> markers;
    markers.reserve(known.size());
    for (const MidpointMarker& marker : known) markers.push_back(marker.marker);
    return markers;
}

/// Collective. Returns this process's share of each list of entities with features, by current
/// global number.
SharedFeatures features_now(const DistributedMesh& mesh, FeatureSlices slices) {
    if (!mesh.features) return nullptr;
    const auto size = static_cast<std::uint64_t>(mesh.processes.size());
    FeatureLists lists;
    for (const Feature f : all_features) {
        const std::uint64_t count = slices.counts()[f];
        if (count == 0) continue;
        const auto share = slices.slice(f, {0, count / size + 1, count});
        lists[f].assign(share.begin(), share.end());
    }
    return std::make_shared<const FeatureLists>(std::move(lists));
}

}  // namespace

void CellsAsRoots::begin(DistributedMesh& mesh, const CanonicalNumbers* known) {
    const Communicator& processes = mesh.processes;
    processes.transaction([&] {
        CanonicalNumbers own_numbers;
        if (known == nullptr) own_numbers = canonical_numbers(mesh);
        const CanonicalNumbers& numbers = known == nullptr ? own_numbers : *known;
        const CanonicalRuns cells = canonical_runs(processes, mesh.cell_ancestors);
        const CanonicalRuns facets = canonical_runs(processes, mesh.facet_ancestors);
        const CanonicalRuns edges = canonical_runs(processes, mesh.edge_ancestors);
        set_aside_.input_vertices.assign(numbers.of_vertex.begin(), numbers.of_vertex.end());
        set_aside_.input_vertex_markers = agreed_markers(mesh);
        set_aside_.cell_ancestors = own_roots(mesh.cell_ancestors, cells);
        set_aside_.facet_ancestors = own_roots(mesh.facet_ancestors, facets);
        set_aside_.edge_ancestors = own_roots(mesh.edge_ancestors, edges);
        set_aside_.input_vertex_count = numbers.vertex_count;
        set_aside_.input_cell_count = cells.count;
        set_aside_.features =
            features_now(mesh, FeatureSlices(mesh, {{{&mesh.edge_ancestors, &edges},
                                                     {&mesh.facet_ancestors, &facets},
                                                     {&mesh.cell_ancestors, &cells}}}));
    });
    set_aside_.swap_with(mesh);
    mesh_ = &mesh;
}

CellsAsRoots::~CellsAsRoots() {
    if (mesh_ != nullptr) set_aside_.swap_with(*mesh_);
}

History CellsAsRoots::keep() noexcept {
    mesh_ = nullptr;
    return std::move(set_aside_);
}

}  // namespace octetra::distributed
