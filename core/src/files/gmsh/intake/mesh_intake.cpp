#include "files/gmsh/intake/mesh_intake.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <octetra/core/huge_pages.hpp>

#include "files/checks/conflicts.hpp"
#include "files/checks/tagged_entities.hpp"
#include "files/input/in_order.hpp"

namespace octetra::gmsh {

MeshIntake::MeshIntake(GrowingMesh& growing, const ReadOptions& options,
                       const std::optional<ElementCounts>& counts)
    : growing_(&growing),
      options_(&options),
      expected_(counts),
      cell_check_(growing.mesh, options) {
    growing.mesh.index_base = 1;
}

std::string MeshIntake::describe(const NodeNumbers::Repeated& repeated) {
    return fmt::format("a second node {}", repeated.tag);
}

void MeshIntake::expect_elements(std::uint64_t count) {
    if (growing_->is_streaming()) {
        const ElementCounts counts = expected_.value_or(ElementCounts{});
        growing_->expect(edge_kind, counts.edges, true);
        growing_->expect(facet_kind, counts.facets, true);
        growing_->expect(cell_kind, counts.cells, true);
    }
    if (!options_->only_syntax) repeated_cells_.emplace(count);
}

template <class I, std::size_t N>
void MeshIntake::make_room(const EntityKind<I, N>& kind, std::uint64_t count) {
    if (growing_->is_streaming()) return;
    auto& list = growing_->mesh.*kind.list;
    auto& markers = growing_->mesh.*kind.markers;
    const std::size_t needed = list.size() + count;
    if (needed <= list.capacity()) return;
    const std::size_t room = std::max(needed, list.size() + list.size() / 2);
    reserve_in_huge_pages(list, room);
    reserve_in_huge_pages(markers, room);
}

template <class I, std::size_t N>
RowError MeshIntake::take(const EntityKind<I, N>& kind,
                          std::span<const std::array<std::uint64_t, N>> rows, Marker marker,
                          std::uint64_t place, std::uint64_t step) {
    std::array<std::array<VertexIndex, N>, most_at_once> room;
    const auto vertices = std::span(room).first(rows.size());
    const RowError missing = find_nodes(rows, vertices);
    const auto found = missing.what.empty() ? vertices : vertices.first(missing.row);
    Taken& of_kind = taken(kind);
    if (!options_->only_syntax) {
        if constexpr (N > 2) {
            if (const RowError wrong = check_entities(found); !wrong.what.empty()) return wrong;
        }
        of_kind.places.add(place, step, found.size());
    }
    if (!missing.what.empty()) return missing;
    if (expected_) {
        const std::uint64_t left = growing_->facts().*kind.count - of_kind.count;
        if (left < rows.size()) return {left, "the file has changed while it was read"};
    }
    of_kind.count += rows.size();
    append(kind, std::span<const std::array<VertexIndex, N>>(vertices),
           untagged_.marker_of(N - 1, marker));
    return {};
}

/// Finds the vertices of the rows, up to the first row that refers to a missing node.
template <std::size_t N>
RowError MeshIntake::find_nodes(std::span<const std::array<std::uint64_t, N>> rows,
                                std::span<std::array<VertexIndex, N>> found) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint64_t* tag = rows[i].data();
        found[i] = taken_in_order<N>([&] { return nodes_.find(*tag++); });
        for (std::size_t k = 0; k < N; ++k) {
            if (!found[i][k].is_none()) continue;
            missing_ = fmt::format(
                "there is no node {}: the file has {} nodes, and their numbers may have gaps",
                rows[i][k], nodes_.size());
            return {i, missing_};
        }
    }
    return {};
}

RowError MeshIntake::check_entities(std::span<CellVertices> cells) {
    const auto [cell, what] = cell_check_.check_entities(cells);
    if (!what.empty()) return {cell, what};
    for (const CellVertices& vertices : cells) repeated_cells_->add(vertices);
    return {};
}

RowError MeshIntake::check_entities(std::span<const FacetVertices> facets) {
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const auto& [a, b, c] = facets[i];
        if (a == b || b == c || c == a) return {i, "the triangle has the same vertex twice"};
    }
    return {};
}

template <class I, std::size_t N>
void MeshIntake::append(const EntityKind<I, N>& kind,
                        std::span<const std::array<VertexIndex, N>> vertices, Marker marker) {
    auto& list = growing_->mesh.*kind.list;
    auto& markers = growing_->mesh.*kind.markers;
    while (!vertices.empty()) {
        const auto some = vertices.first(std::min(vertices.size(), growing_->room_for(kind)));
        list.insert(list.end(), some.begin(), some.end());
        markers.insert(markers.end(), some.size(), marker);
        growing_->entity_complete(kind);
        vertices = vertices.subspan(some.size());
    }
}

template <class I, std::size_t N>
void MeshIntake::remove_first(const EntityKind<I, N>& kind, std::uint64_t count) {
    auto& list = growing_->mesh.*kind.list;
    auto& markers = growing_->mesh.*kind.markers;
    list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
    markers.erase(markers.begin(), markers.begin() + static_cast<std::ptrdiff_t>(count));
    ignored_.in_another_group += count;
}

template <class I, std::size_t N>
void MeshIntake::complete(const EntityKind<I, N>& kind) {
    if (tags_) tags_->number(growing_->mesh.*kind.list);
    growing_->all_complete(kind);
    growing_->count_complete(kind);
}

void MeshIntake::elements_complete() {
    complete(edge_kind);
    complete(facet_kind);
    complete(cell_kind);
}

void MeshIntake::check(bool has_lines, std::uint64_t end_position, const Fail& fail) {
    ignored_.add_up(growing_->group());
    if (options_->only_syntax && !growing_->is_share()) return;
    const MeshFacts& facts = growing_->facts();
    if (const std::string wrong = error_without_cells(facts.cells, facts.facets, ignored_);
        !wrong.empty()) {
        fail(wrong, facets_.places.empty() ? end_position : facets_.places.of(0));
    }
    if (options_->only_syntax) return;
    const Mesh& mesh = growing_->mesh;
    const auto lines_of = [has_lines](const Taken& taken) {
        return [has_lines, &taken](std::uint64_t entry) {
            return has_lines ? std::optional(taken.places.of(entry)) : std::nullopt;
        };
    };
    const auto refuse = [&](const auto& wrong, std::string_view name, const auto& markers,
                            const Taken& of_kind) {
        if (wrong.entry.is_none()) return;
        fail(describe_wrong(wrong, name, markers, mesh, lines_of(of_kind)),
             of_kind.places.of(wrong.entry.value()));
    };
    if (repeated_cells_) {
        const CellPair pair = repeated_cells_->find(mesh.cells, mesh.points.size());
        if (!pair.cell.is_none()) {
            fail(describe_repeated(pair, mesh, lines_of(cells_)),
                 cells_.places.of(pair.cell.value()));
        }
    }
    const WrongFacets wrong = find_wrong_facets(mesh);
    if (const CellIndex cell = wrong.overlap.cell; !cell.is_none()) {
        fail(describe_overlap(wrong, mesh, lines_of(cells_)), cells_.places.of(cell.value()));
    }
    refuse(wrong.tagged, "triangle", mesh.facet_markers, facets_);
    refuse(find_wrong_edge(mesh), "line", mesh.edge_markers, edges_);
}

void MeshIntake::add_notes(const std::string& path) const {
    if (const std::uint64_t fixed = cell_check_.fixed_count(); fixed > 0) {
        options_->note(fmt::format("{}: {} inverted cells were reversed", path, fixed));
    }
    note_ignored(ignored_, path, options_->note);
}

ElementCounts MeshIntake::counts() const { return {cells_.count, facets_.count, edges_.count}; }

template void MeshIntake::make_room(const EntityKind<CellIndex, 4>&, std::uint64_t);
template void MeshIntake::make_room(const EntityKind<FacetIndex, 3>&, std::uint64_t);
template void MeshIntake::make_room(const EntityKind<EdgeIndex, 2>&, std::uint64_t);
template void MeshIntake::remove_first(const EntityKind<CellIndex, 4>&, std::uint64_t);
template void MeshIntake::remove_first(const EntityKind<FacetIndex, 3>&, std::uint64_t);
template void MeshIntake::remove_first(const EntityKind<EdgeIndex, 2>&, std::uint64_t);
template RowError MeshIntake::take(const EntityKind<CellIndex, 4>&,
                                   std::span<const std::array<std::uint64_t, 4>>, Marker,
                                   std::uint64_t, std::uint64_t);
template RowError MeshIntake::take(const EntityKind<FacetIndex, 3>&,
                                   std::span<const std::array<std::uint64_t, 3>>, Marker,
                                   std::uint64_t, std::uint64_t);
template RowError MeshIntake::take(const EntityKind<EdgeIndex, 2>&,
                                   std::span<const std::array<std::uint64_t, 2>>, Marker,
                                   std::uint64_t, std::uint64_t);

}  // namespace octetra::gmsh
