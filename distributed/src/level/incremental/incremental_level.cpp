#include "level/incremental/incremental_level.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <octetra/core/huge_pages.hpp>

#include "level/rounding_margin.hpp"
#include "pattern/triangle.hpp"

namespace octetra::distributed {
namespace {

/// Converts triangles with one bisected edge each, by its position in triangle_edges, to triangles
/// with all of their bisected edges, ascending by key.
template <class CutTriangle, class OneCut>
std::vector<CutTriangle> merged_cuts(std::vector<OneCut> cuts) {
    std::ranges::sort(cuts, {}, &OneCut::key);
    std::vector<CutTriangle> triangles;
    for (const auto& [key, edge, midpoint] : cuts) {
        if (triangles.empty() || triangles.back().key != key) triangles.push_back({key});
        triangles.back().midpoints[edge] = midpoint;
    }
    return triangles;
}

template <class Key>
struct OneCut {
    Key key;
    std::size_t edge = 0;
    VertexIndex midpoint;
};

struct NumberedEdge {
    std::uint64_t ends = 0;  ///< the lower end in the higher bits
    EdgeIndex number;
};

/// Sorts edges by (lower, higher) end.
std::vector<NumberedEdge> sorted_by_ends(const IndexVector<EdgeIndex, EdgeVertices>& edges) {
    std::vector<NumberedEdge> sorted;
    sorted.reserve(edges.size());
    for (EdgeIndex e{0}; e < edges.end_index(); ++e) {
        const auto [low, high] = edges[e];
        sorted.push_back({std::uint64_t{low.value()} << 32U | high.value(), e});
    }
    std::ranges::sort(sorted, {}, &NumberedEdge::ends);
    return sorted;
}

/// Returns the number of children beyond the first, which is also the number of edges between
/// children.
std::size_t count_of_cuts(const auto& triangle) {
    return static_cast<std::size_t>(
        std::ranges::count_if(triangle.midpoints, [](VertexIndex v) { return !v.is_none(); }));
}

}  // namespace

IncrementalLevel::IncrementalLevel(DistributedMesh& mesh, const TransitionCells* transition)
    : mesh_(&mesh), adjacency_(&Adjacency::of(mesh)), closure_(mesh, *adjacency_, transition) {}

void IncrementalLevel::mark(const MarkedCells& marked, Scheme scheme) {
    for (std::size_t k = 0; k < marked.cells.size(); ++k) {
        const CellIndex c = marked.cells[k];
        closure_.mark(
            c, marked.edges.empty() ? marks_of(scheme, closure_.order_of(c)) : marked.edges[k]);
    }
}

IncrementalLevel::~IncrementalLevel() {
    if (appended_ == nullptr) return;
    appended_.reset();
    adjacency_->set_vertex_count(mesh_->points.size());
}

void IncrementalLevel::bisect_edges() {
    const auto& edges = closure_.edges();
    appended_ = std::make_unique<AppendedMidpoints>(*mesh_);
    midpoints_.resize(edges.size());
    const bool has_markers = !mesh_->input_vertex_markers.empty();
    for (const auto& [ends, e] : sorted_by_ends(edges)) {
        const auto [low, high] = edges[e];
        midpoints_[e] = mesh_->points.end_index();
        append_midpoint(*mesh_, low, high);
        if (has_markers) mesh_->midpoint_markers.push_back(marker_of(edges[e]));
    }
    adjacency_->set_vertex_count(mesh_->points.size());
}

MidpointMarker IncrementalLevel::marker_of(const EdgeVertices& edge) const {
    MidpointMarker known;
    const auto merge_markers = [&](const auto& unordered, const auto& list,
                                   const AncestorMap& ancestors, MidpointMarker::Source source) {
        if (ancestors.markers.empty()) return;
        unordered.for_each_with(edge, list, [&](auto i, std::size_t) {
            merge_marker(known, source, ancestors.markers[unordered.root_of(i)]);
        });
    };
    merge_markers(adjacency_->facets, mesh_->facets, mesh_->facet_ancestors,
                  MidpointMarker::Source::facet);
    merge_markers(adjacency_->edges, mesh_->edges, mesh_->edge_ancestors,
                  MidpointMarker::Source::edge);
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

MarkedCells IncrementalLevel::closed_marks() {
    std::vector<std::pair<CellIndex, EdgeMask>> marks;
    for (const auto& note : closure_.notes()) {
        if (note.marked != 0) marks.emplace_back(note.cell, note.marked);
    }
    std::ranges::sort(marks);
    MarkedCells closed{.count = marks.size()};
    for (const auto& [cell, edges] : marks) {
        closed.cells.push_back(cell);
        closed.edges.push_back(edges);
    }
    return closed;
}

RoundingFailure IncrementalLevel::bisect_cells(std::size_t cell_count) {
    std::vector<BadParent> bad;
    new_cells_.reserve(closure_.notes().size() + cell_count - mesh_->cells.size());
    for (const auto& note : closure_.notes()) {
        new_cells_.push_back(note.cell);
        if (has_rounding_margin(mesh_->points, mesh_->cells[note.cell])) continue;
        const int sign = sign_of_first_bad_child(note);
        if (sign > 0) continue;
        bad.push_back({note.cell, adjacency_->cells.root_of(note.cell), sign});
    }
    for (CellIndex c = mesh_->cells.end_index(); c < CellIndex{cell_count}; ++c) {
        new_cells_.push_back(c);
    }
    adjacency_->cells.make_room(cell_count - mesh_->cells.size(), mesh_->cells);
    adjacency_->blocks.make_room(cell_count);
    make_room(adjacency_->cell_to_note, cell_count);
    return first_of(std::move(bad));
}

std::array<CellVertices, 8> IncrementalLevel::children_of(
    const IncrementalClosure::Note& note) const {
    std::array<VertexIndex, 10> vertices;  // corners, then midpoints of edges
    std::ranges::copy(mesh_->cells[note.cell], vertices.begin());
    for (std::size_t e = 0; e < 6; ++e) {
        if ((note.marked >> e & 1U) != 0) vertices[4 + e] = midpoints_[note.edges[e]];
    }
    const Pattern& pattern = pattern_of(note);
    std::array<CellVertices, 8> children;
    for (std::size_t k = 0; k < pattern.child_count; ++k) {
        children[k] = child_of(vertices, pattern.children[k]);
    }
    return children;
}

/// Returns the sign of the first flat or inverted child, or 1 if there is none.
int IncrementalLevel::sign_of_first_bad_child(const IncrementalClosure::Note& note) const {
    const auto children = children_of(note);
    for (std::size_t k = 0; k < pattern_of(note).child_count; ++k) {
        const int sign = sign_of(children[k], mesh_->points);
        if (sign <= 0) return sign;
    }
    return 1;
}

RoundingFailure IncrementalLevel::first_of(std::vector<BadParent> bad) const {
    RoundingFailure failure;
    if (bad.empty()) return failure;
    std::ranges::sort(bad, {}, &BadParent::cell);
    const std::uint32_t root = std::ranges::min_element(bad, {}, &BadParent::root)->root;
    // Visits the root's descendants in canonical order until the first bad one.
    for (CellIndex c{mesh_->cell_ancestors.first[root]}; !failure.found();
         c = adjacency_->cells.next(c)) {
        const auto found = std::ranges::lower_bound(bad, c, {}, &BadParent::cell);
        if (found == bad.end() || found->cell != c) continue;
        failure.note(mesh_->cell_ancestors.roots[root], found->sign);
    }
    return failure;
}

void IncrementalLevel::bisect_tagged() {
    std::vector<OneCut<FacetIndex>> facet_cuts;
    for (EdgeIndex e{0}; e < closure_.edges().end_index(); ++e) {
        const EdgeVertices& edge = closure_.edges()[e];
        const VertexIndex midpoint = midpoints_[e];
        adjacency_->facets.for_each_with(edge, mesh_->facets, [&](FacetIndex f, std::size_t k) {
            facet_cuts.push_back({f, k, midpoint});
        });
        adjacency_->edges.for_each_with(edge, mesh_->edges, [&](EdgeIndex tagged, std::size_t) {
            cut_tagged_edges_.push_back({tagged, midpoint});
        });
    }
    adjacency_->facets.make_room(facet_cuts.size(), mesh_->facets);
    adjacency_->edges.make_room(cut_tagged_edges_.size(), mesh_->edges);
    cut_facets_ = merged_cuts<CutTriangle<FacetIndex>>(std::move(facet_cuts));
}

// The other rank may use a full sweep: the order is that of bisect_interfaces.hpp.
void IncrementalLevel::bisect_interfaces() {
    if (mesh_->interfaces.empty()) return;
    find_shared_cuts();
    make_room_in_interfaces();
}

void IncrementalLevel::find_shared_cuts() {
    std::vector<OneCut<SharedFace>> face_cuts;
    for (EdgeIndex e{0}; e < closure_.edges().end_index(); ++e) {
        const EdgeVertices& edge = closure_.edges()[e];
        adjacency_->shared_edges.for_each_with(edge, mesh_->interfaces, [&](const auto& found) {
            cut_shared_edges_.push_back({found.place, found.index, midpoints_[e]});
        });
        adjacency_->shared_faces.for_each_with(edge, mesh_->interfaces, [&](const auto& found) {
            face_cuts.push_back({{found.place, found.index}, found.edge, midpoints_[e]});
        });
    }
    std::ranges::sort(cut_shared_edges_, {}, &CutSharedEdge::place);
    cut_shared_faces_ = merged_cuts<CutTriangle<SharedFace>>(std::move(face_cuts));
}

void IncrementalLevel::make_room_in_interfaces() {
    std::vector<std::size_t> edges(mesh_->interfaces.size(), 0);
    std::vector<std::size_t> faces(mesh_->interfaces.size(), 0);
    for (const auto& cut : cut_shared_edges_) ++edges[cut.place.interface];
    for (const auto& face : cut_shared_faces_) {
        edges[face.key.place.interface] += count_of_cuts(face);
        faces[face.key.place.interface] += count_of_cuts(face);
    }
    adjacency_->shared_edges.make_room(edges, mesh_->interfaces);
    adjacency_->shared_faces.make_room(faces, mesh_->interfaces);
}

std::vector<std::vector<VertexIndex>> IncrementalLevel::shared_midpoints() const {
    std::vector<std::vector<VertexIndex>> midpoints(mesh_->interfaces.size());
    for (const CutSharedEdge& cut : cut_shared_edges_) {
        midpoints[cut.place.interface].push_back(cut.midpoint);
    }
    return midpoints;
}

ListChanges IncrementalLevel::changes() {
    using Cuts = std::vector<EntityTransfer::Cut>;
    Cuts cells;
    for (const auto& note : closure_.notes()) {
        cells.push_back({note.cell.value(), pattern_of(note).division});
    }
    Cuts facets;
    for (const auto& [facet, midpoints] : cut_facets_) {
        facets.push_back({facet.value(), division_of(bisect_triangle(mesh_->facets[facet],
                                                                     midpoints, mesh_->points))});
    }
    Cuts edges;
    for (const CutEdge& cut : cut_tagged_edges_) edges.push_back({cut.edge.value(), 1});
    return {EntityTransfer::of_cuts(mesh_->cells.size(), std::move(cells),
                                    PatternTable::get().divisions()),
            EntityTransfer::of_cuts(mesh_->facets.size(), std::move(facets), triangle_divisions),
            EntityTransfer::of_cuts(mesh_->edges.size(), std::move(edges), edge_divisions)};
}

void IncrementalLevel::commit() noexcept {
    change_lists();
    appended_->keep();
    appended_.reset();
}

void IncrementalLevel::change_lists() noexcept {
    commit_cells();
    commit_tagged();
    commit_shared_edges();
    commit_shared_faces();
}

void IncrementalLevel::commit_cells() {
    const CellIndex first_added = mesh_->cells.end_index();
    for (const auto& note : closure_.notes()) {
        const auto children = children_of(note);
        adjacency_->cells.replace(
            note.cell, std::span(children).first(pattern_of(note).child_count), mesh_->cells);
    }
    adjacency_->new_cells = std::move(new_cells_);
    adjacency_->blocks.append(*mesh_, first_added);
    adjacency_->cell_to_note.resize(mesh_->cells.size(), CellIndex::none_value);
}

void IncrementalLevel::commit_tagged() {
    for (const auto& [facet, midpoints] : cut_facets_) {
        const BisectedTriangle bisected =
            bisect_triangle(mesh_->facets[facet], midpoints, mesh_->points);
        adjacency_->facets.replace(facet, std::span(bisected.pieces).first(bisected.piece_count),
                                   mesh_->facets);
    }
    for (const auto& [tagged, midpoint] : cut_tagged_edges_) {
        const auto [a, b] = mesh_->edges[tagged];
        const std::array<EdgeVertices, 2> halves{{{a, midpoint}, {midpoint, b}}};
        adjacency_->edges.replace(tagged, halves, mesh_->edges);
    }
}

void IncrementalLevel::commit_shared_edges() {
    for (const auto& [place, index, midpoint] : cut_shared_edges_) {
        const auto [a, b] = mesh_->interfaces[place.interface].edges[place.position];
        adjacency_->shared_edges.replace(index, {a, midpoint}, mesh_->interfaces);
        adjacency_->shared_edges.append(place.interface, {midpoint, b}, mesh_->interfaces);
    }
}

void IncrementalLevel::commit_shared_faces() {
    auto& interfaces = mesh_->interfaces;
    for (const auto& [face, midpoints] : cut_shared_faces_) {
        const std::uint32_t interface = face.place.interface;
        const BisectedTriangle bisected = bisect_triangle(
            interfaces[interface].faces[face.place.position], midpoints, mesh_->points);
        adjacency_->shared_faces.replace(face.index, bisected.pieces[0], interfaces);
        for (std::size_t k = 1; k < bisected.piece_count; ++k) {
            adjacency_->shared_faces.append(interface, bisected.pieces[k], interfaces);
        }
        for (std::size_t k = 0; k < bisected.inner_edge_count; ++k) {
            adjacency_->shared_edges.append(interface, bisected.inner_edges[k], interfaces);
        }
    }
}

}  // namespace octetra::distributed
