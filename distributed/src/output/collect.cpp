#include <utility>

#include <octetra/distributed/distributed_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "output/canonical_slices.hpp"

namespace octetra::distributed {
namespace {

/// The markers of a process's own vertices, when it has all of them.
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

/// One process's vertices, cells and lists are in canonical order as they are.
Collected hand_over(DistributedMesh part) {
    Collected whole;
    Mesh& mesh = whole.mesh;
    mesh.point_markers = own_markers(part);
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

void assign(auto& list, const auto& slice) { list.assign(slice.begin(), slice.end()); }

/// One slice of everything, the first process's.
Collected gather(const DistributedMesh& part) {
    CanonicalSlices slices(part);
    const MeshFacts& facts = slices.facts();
    Collected whole;
    Mesh& mesh = whole.mesh;
    const Window vertices = whole_window(facts.vertices);
    const Window cells = whole_window(facts.cells);
    const Window facets = whole_window(facts.facets);
    const Window edges = whole_window(facts.edges);
    assign(mesh.points, slices.points(vertices));
    if (facts.has_point_markers) assign(mesh.point_markers, slices.point_markers(vertices));
    if (part.processes.is_first()) mesh.attributes_per_point = facts.attributes_per_point;
    assign(mesh.point_attributes, slices.point_attributes(vertices));
    assign(mesh.cells, slices.cells(cells));
    if (facts.has_regions) assign(mesh.regions, slices.regions(cells));
    assign(mesh.facets, slices.facets(facets));
    if (facts.has_facet_markers) assign(mesh.facet_markers, slices.facet_markers(facets));
    assign(mesh.edges, slices.edges(edges));
    if (facts.has_edge_markers) assign(mesh.edge_markers, slices.edge_markers(edges));
    assign(whole.maps.cell_to_parent, slices.parents(cells));
    assign(whole.maps.midpoint_to_edge,
           slices.midpoint_ends(whole_window(facts.vertices - facts.first_midpoint)));
    return whole;
}

}  // namespace

Collected collect(DistributedMesh mesh) {
    const Communicator processes = mesh.processes;  // the mesh may be gone before the phase ends
    if (processes.size() > 1) return collect_copy(mesh);
    const Phase phase(processes, "collect");
    restore_canonical_order(mesh);
    const std::uint32_t index_base = mesh.index_base;
    const VertexIndex first_midpoint{mesh.input_vertex_count};
    Collected whole = hand_over(std::move(mesh));
    whole.mesh.index_base = index_base;
    whole.maps.first_midpoint = first_midpoint;
    return whole;
}

Collected collect_copy(const DistributedMesh& mesh) {
    const Phase phase(mesh.processes, "collect");
    Collected whole = gather(mesh);
    whole.mesh.index_base = mesh.index_base;
    whole.maps.first_midpoint = VertexIndex{mesh.input_vertex_count};
    return whole;
}

}  // namespace octetra::distributed
