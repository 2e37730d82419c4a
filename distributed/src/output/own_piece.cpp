#include "output/own_piece.hpp"

#include <algorithm>
#include <variant>

#include <octetra/distributed/exchange.hpp>

#include "numbering/vertex_markers.hpp"
#include "output/check_fields.hpp"

namespace octetra::distributed {
namespace {

/// Calls emit(root) for each cell of the window.
void for_each_root(const AncestorMap& ancestors, const Window& window, auto&& emit) {
    const std::uint64_t begin = window.begin_of(0);
    const auto after = std::ranges::upper_bound(ancestors.first, begin);
    auto root = static_cast<std::size_t>(after - ancestors.first.begin()) - 1;
    for (std::uint64_t c = begin; c < window.end_of(0); ++c) {
        while (ancestors.first[root + 1] <= c) ++root;
        emit(root);
    }
}

/// Returns the values of each entity of the piece, reordered from the indices in `before`.
std::vector<std::byte> bytes_in_order(std::span<const std::byte> values, std::size_t entity_size,
                                      std::span<const CellIndex> before) {
    if (before.empty()) return {values.begin(), values.end()};
    std::vector<std::byte> bytes(values.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        std::ranges::copy(values.subspan(before[i].value() * entity_size, entity_size),
                          bytes.begin() + static_cast<std::ptrdiff_t>(i * entity_size));
    }
    return bytes;
}

}  // namespace

OwnPiece::OwnPiece(const DistributedMesh& mesh, const OrderedLists& lists,
                   const CanonicalNumbers& numbers, const MeshFacts& whole)
    : mesh_(&mesh), lists_(&lists), numbers_(&numbers), facts_(whole) {
    facts_.vertices = mesh.points.size();
    facts_.cells = mesh.cells.size();
    facts_.facets = mesh.facets.size();
    facts_.edges = mesh.edges.size();
    facts_.first_midpoint = facts_.vertices;
    facts_.has_vertex_numbers = true;
    if (whole.has_point_markers) point_markers_ = vertex_markers(mesh, numbers);
}

std::span<const Point> OwnPiece::points(const Window& w) { return slice(mesh_->points, w); }

std::span<const Marker> OwnPiece::point_markers(const Window& w) {
    return slice(point_markers_, w);
}

std::span<const double> OwnPiece::point_attributes(const Window& w) {
    return slice(mesh_->point_attributes, w, mesh_->attributes_per_point);
}

std::span<const std::uint64_t> OwnPiece::vertex_numbers(const Window& w) {
    vertex_numbers_.clear();
    for (std::uint64_t v = w.begin_of(0); v < w.end_of(0); ++v) {
        vertex_numbers_.push_back(static_cast<std::uint64_t>(numbers_->of_vertex[VertexIndex{v}]));
    }
    return vertex_numbers_;
}

std::span<const VertexNumbers<4>> OwnPiece::cells(const Window& w) {
    cells_.clear();
    for (const auto& [a, b, c, d] : slice(lists_->cells.list(), w)) {
        cells_.push_back({a.value(), b.value(), c.value(), d.value()});
    }
    return cells_;
}

std::span<const Marker> OwnPiece::regions(const Window& w) {
    regions_.clear();
    for_each_root(lists_->cells.ancestors(), w, [&](std::size_t root) {
        regions_.push_back(lists_->cells.ancestors().markers[root]);
    });
    return regions_;
}

std::span<const std::uint64_t> OwnPiece::parents(const Window& w) {
    parents_.clear();
    for_each_root(lists_->cells.ancestors(), w, [&](std::size_t root) {
        parents_.push_back(lists_->cells.ancestors().roots[root]);
    });
    return parents_;
}

void OwnPiece::add(std::span<const Field> fields, const Sharing<VertexIndex>& sharing) {
    for (const Field& field : fields) add(field, sharing);
}

void OwnPiece::add(const Field& field, const Sharing<VertexIndex>& sharing) {
    field_facts_.push_back(facts_of(field));
    const std::size_t entity_size = field.components * size_of(field_facts_.back().type);
    std::visit(
        [&](const auto& values) {
            auto agreed = values;
            const bool on_vertices = field.on == FieldOn::vertices;
            if (on_vertices) {
                update_copies(mesh_->processes, sharing, mesh_->points.size(), std::span(agreed),
                              field.components);
            }
            field_values_.push_back(bytes_in_order(
                std::as_bytes(std::span(agreed)), entity_size,
                on_vertices ? std::span<const CellIndex>{} : lists_->cells.before()));
        },
        field.values);
}

std::span<const std::byte> OwnPiece::field_values(std::size_t field, const Window& window) {
    const FieldFacts& facts = field_facts_[field];
    return slice(field_values_[field], window, facts.components * size_of(facts.type));
}

}  // namespace octetra::distributed
