#include "level/incremental/incremental_level.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <octetra/distributed/profile.hpp>

#include "level/midpoints.hpp"
#include "level/rounding_margin.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {
namespace {

Adjacency& adjacency_of(DistributedMesh& mesh) {
    const Phase phase(mesh.processes, "adjacency");
    if (mesh.adjacency == nullptr) mesh.adjacency.reset(new Adjacency(mesh));
    return *mesh.adjacency;
}

/// An entity, by a key, one of whose edges is bisected.
template <class Key>
struct Cut {
    Key key;
    std::size_t edge = 0;  ///< as triangle_edges numbers them
    VertexIndex midpoint;
};

/// Calls bisect(key, midpoints of all three edges) for each triangle that has a cut, in ascending
/// order.
template <class Key>
void for_each_triangle(std::vector<Cut<Key>> cuts, auto&& bisect) {
    std::ranges::sort(cuts, {}, &Cut<Key>::key);
    for (auto cut = cuts.begin(); cut != cuts.end();) {
        const Key key = cut->key;
        std::array<VertexIndex, 3> midpoints{};  // none
        for (; cut != cuts.end() && cut->key == key; ++cut) midpoints[cut->edge] = cut->midpoint;
        bisect(key, midpoints);
    }
}

}  // namespace

IncrementalLevel::IncrementalLevel(DistributedMesh& mesh)
    : mesh_(&mesh), adjacency_(&adjacency_of(mesh)), closure_(mesh, *adjacency_) {}

void IncrementalLevel::mark(const MarkedCells& marked, Scheme scheme) {
    for (const CellIndex c : marked.cells) {
        closure_.mark(c, marks_of(scheme, closure_.order_of(c)));
    }
}

void IncrementalLevel::bisect_edges() {
    const auto& edges = closure_.edges();
    std::vector<EdgeIndex> in_order;
    for (EdgeIndex e{0}; e < edges.end_index(); ++e) in_order.push_back(e);
    std::ranges::sort(in_order, {}, [&](EdgeIndex e) { return edges[e]; });

    mesh_->level_begin.push_back(mesh_->points.end_index());
    midpoints_.resize(edges.size());
    const bool has_markers = !mesh_->input_vertex_markers.empty();
    for (const EdgeIndex e : in_order) {
        const auto [low, high] = edges[e];
        midpoints_[e] = mesh_->points.end_index();
        append_midpoint(*mesh_, low, high);
        if (has_markers) mesh_->midpoint_markers.push_back(marker_of(edges[e]));
    }
    adjacency_->add_vertices(edges.size());
}

MidpointMarker IncrementalLevel::marker_of(const EdgeVertices& edge) const {
    MidpointMarker known;
    const auto learn = [&](const auto& unordered, const auto& list, const AncestorMap& ancestors,
                           MidpointMarker::Source source) {
        if (ancestors.markers.empty()) return;
        unordered.for_each_with(edge, list, [&](auto i, std::size_t) {
            take_marker(known, source, ancestors.markers[unordered.root_of(i, ancestors)]);
        });
    };
    learn(adjacency_->facets, mesh_->facets, mesh_->facet_ancestors, MidpointMarker::Source::facet);
    learn(adjacency_->edges, mesh_->edges, mesh_->edge_ancestors, MidpointMarker::Source::edge);
    return known;
}

const Pattern& IncrementalLevel::pattern_of(const IncrementalClosure::Note& note) const {
    return PatternTable::get().pattern(note.order, note.marked);
}

std::size_t IncrementalLevel::cell_count_afterwards() {
    std::size_t count = mesh_->cells.size() - closure_.notes().size();
    for (const auto& note : closure_.notes()) count += pattern_of(note).child_count;
    return count;
}

RoundingFailure IncrementalLevel::bisect_cells(std::size_t cell_count) {
    const CellIndex first_added = mesh_->cells.end_index();
    std::vector<BadChild> bad;
    adjacency_->new_cells.clear();
    for (const auto& note : closure_.notes()) bisect(note, bad);
    for (CellIndex c = first_added; c < CellIndex{cell_count}; ++c) {
        adjacency_->new_cells.push_back(c);
    }
    adjacency_->blocks.append(*mesh_, first_added);
    adjacency_->cell_to_note.resize(cell_count, CellIndex::none_value);
    return first_of(std::move(bad));
}

void IncrementalLevel::bisect(const IncrementalClosure::Note& note, std::vector<BadChild>& bad) {
    adjacency_->cell_to_note[note.cell] = CellIndex::none_value;
    adjacency_->new_cells.push_back(note.cell);

    std::array<VertexIndex, 10> vertices;  // by place
    std::ranges::copy(mesh_->cells[note.cell], vertices.begin());
    for (std::size_t e = 0; e < 6; ++e) {
        if ((note.marked >> e & 1U) != 0) vertices[4 + e] = midpoints_[note.edges[e]];
    }
    const Pattern& pattern = pattern_of(note);
    std::array<CellVertices, 8> children;
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        children[k] = child_of(vertices, pattern.children[k]);
    }
    const bool is_safe = has_rounding_margin(mesh_->points, mesh_->cells[note.cell]);
    const CellIndex first_added = mesh_->cells.end_index();
    adjacency_->cells.replace(note.cell, std::span(children).first(pattern.child_count),
                              mesh_->cells, mesh_->cell_ancestors);
    if (is_safe) return;
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        const int sign = sign_of(children[k], mesh_->points);
        if (sign > 0) continue;
        const CellIndex cell =
            k == 0 ? note.cell : CellIndex{std::size_t{first_added.value()} + k - 1};
        bad.push_back({cell, adjacency_->cells.root_of(cell, mesh_->cell_ancestors), sign});
    }
}

RoundingFailure IncrementalLevel::first_of(std::vector<BadChild> bad) const {
    RoundingFailure failure;
    if (bad.empty()) return failure;
    std::ranges::sort(bad, {}, &BadChild::cell);
    const std::uint32_t root = std::ranges::min_element(bad, {}, &BadChild::root)->root;
    // The root's descendants in order, of which one is bad.
    for (CellIndex c{mesh_->cell_ancestors.first[root]}; !failure.found();
         c = adjacency_->cells.next(c)) {
        const auto found = std::ranges::lower_bound(bad, c, {}, &BadChild::cell);
        if (found == bad.end() || found->cell != c) continue;
        failure.note(mesh_->cell_ancestors.roots[root], found->sign);
    }
    return failure;
}

void IncrementalLevel::bisect_tagged() {
    std::vector<Cut<FacetIndex>> facet_cuts;
    std::vector<std::pair<EdgeIndex, VertexIndex>> edge_cuts;
    for (EdgeIndex e{0}; e < closure_.edges().end_index(); ++e) {
        const EdgeVertices& edge = closure_.edges()[e];
        const VertexIndex midpoint = midpoints_[e];
        adjacency_->facets.for_each_with(edge, mesh_->facets, [&](FacetIndex f, std::size_t k) {
            facet_cuts.push_back({f, k, midpoint});
        });
        adjacency_->edges.for_each_with(edge, mesh_->edges, [&](EdgeIndex tagged, std::size_t) {
            edge_cuts.emplace_back(tagged, midpoint);
        });
    }
    for_each_triangle(std::move(facet_cuts), [&](FacetIndex f, const auto& midpoints) {
        const BisectedTriangle bisected =
            bisect_triangle(mesh_->facets[f], midpoints, mesh_->points);
        adjacency_->facets.replace(f, std::span(bisected.pieces).first(bisected.piece_count),
                                   mesh_->facets, mesh_->facet_ancestors);
    });
    for (const auto& [tagged, midpoint] : edge_cuts) {
        const auto [a, b] = mesh_->edges[tagged];
        const std::array<EdgeVertices, 2> halves{{{a, midpoint}, {midpoint, b}}};
        adjacency_->edges.replace(tagged, halves, mesh_->edges, mesh_->edge_ancestors);
    }
}

// The other side may go through all of its list: the order is that of bisect_interfaces.hpp.
void IncrementalLevel::bisect_interfaces() {
    if (mesh_->interfaces.empty()) return;
    bisect_shared_edges();
    bisect_shared_faces();
}

void IncrementalLevel::bisect_shared_edges() {
    struct SharedCut {
        SharedEntities<2>::Found edge;
        VertexIndex midpoint;
    };
    std::vector<SharedCut> cuts;
    for (EdgeIndex e{0}; e < closure_.edges().end_index(); ++e) {
        adjacency_->shared_edges.for_each_with(closure_.edges()[e], mesh_->interfaces,
                                               [&](const auto& found) {
                                                   cuts.push_back({found, midpoints_[e]});
                                               });
    }
    std::ranges::sort(cuts, {}, [](const SharedCut& cut) { return cut.edge.place; });
    for (const auto& [edge, midpoint] : cuts) {
        const auto [interface, position] = edge.place;
        const auto [a, b] = mesh_->interfaces[interface].edges[position];
        adjacency_->shared_edges.replace(edge.index, {a, midpoint}, mesh_->interfaces);
        adjacency_->shared_edges.append(interface, {midpoint, b}, mesh_->interfaces);
    }
}

void IncrementalLevel::bisect_shared_faces() {
    using Face = std::pair<SharedPlace, SharedIndex>;
    std::vector<Cut<Face>> cuts;
    for (EdgeIndex e{0}; e < closure_.edges().end_index(); ++e) {
        adjacency_->shared_faces.for_each_with(
            closure_.edges()[e], mesh_->interfaces, [&](const auto& face) {
                cuts.push_back({{face.place, face.index}, face.edge, midpoints_[e]});
            });
    }
    auto& interfaces = mesh_->interfaces;
    for_each_triangle(std::move(cuts), [&](const Face& face, const auto& midpoints) {
        const auto& [place, index] = face;
        const std::uint32_t interface = place.interface;
        const BisectedTriangle bisected =
            bisect_triangle(interfaces[interface].faces[place.position], midpoints, mesh_->points);
        adjacency_->shared_faces.replace(index, bisected.pieces[0], interfaces);
        for (std::size_t k = 1; k < bisected.piece_count; ++k) {
            adjacency_->shared_faces.append(interface, bisected.pieces[k], interfaces);
        }
        for (std::size_t k = 0; k < bisected.inner_edge_count; ++k) {
            adjacency_->shared_edges.append(interface, bisected.inner_edges[k], interfaces);
        }
    });
}

}  // namespace octetra::distributed
