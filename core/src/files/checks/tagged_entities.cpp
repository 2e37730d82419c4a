#include "files/checks/tagged_entities.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <octetra/core/vertex_buckets.hpp>

namespace octetra {
namespace {

/// The vertices of a list of entities, with branch-free lookup.
class VertexSet {
public:
    template <class I, std::size_t N>
    VertexSet(const IndexVector<I, std::array<VertexIndex, N>>& list, std::size_t vertex_count)
        : is_in_(vertex_count, 0) {
        for (const auto& vertices : list) {
            for (const VertexIndex v : vertices) is_in_[v.value()] = 1;
        }
    }
    /// Returns a bit for each of the cell's vertices that is in the set.
    [[nodiscard]] unsigned in(const CellVertices& cell) const {
        unsigned corners = 0;
        for (std::size_t k = 0; k < 4; ++k) corners |= unsigned{is_in_[cell[k].value()]} << k;
        return corners;
    }

private:
    std::vector<std::uint8_t> is_in_;
};

/// Returns a bit for each corner of a cell that a side has.
template <std::size_t N>
constexpr unsigned corners_of(const std::array<std::uint8_t, N>& side) {
    unsigned corners = 0;
    for (const std::uint8_t k : side) corners |= 1U << k;
    return corners;
}

/// Returns for each set of corners whether it contains those of a side.
template <std::size_t N, std::size_t Sides>
std::array<bool, 16> with_a_side(const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::array<bool, 16> has{};
    for (unsigned corners = 0; corners < has.size(); ++corners) {
        has[corners] = std::ranges::any_of(sides, [&](const auto& side) {
            return (corners & corners_of(side)) == corners_of(side);
        });
    }
    return has;
}

/// Finds the first entry of the list that no cell has among its `sides` (faces or edges), or that
/// repeats an earlier one with another marker. Calls met(c, k, vertices, i) if side k of cell c,
/// which has these vertices, is entry i.
template <class I, std::size_t N, std::size_t Sides>
WrongEntry<I> find_wrong(const Mesh& mesh, const IndexVector<I, std::array<VertexIndex, N>>& list,
                         const IndexVector<I, Marker>& markers,
                         const std::array<std::array<std::uint8_t, N>, Sides>& sides, auto&& met) {
    if (list.empty()) return {};
    const VertexBuckets<I, N> buckets(list, mesh.points.size());
    const VertexSet corners_of_list(list, mesh.points.size());
    const std::array<bool, 16> has_side = with_a_side(sides);
    std::vector<bool> of_cells(list.size(), false);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        // If only the boundary is tagged, most cells have too few such corners.
        const unsigned corners = corners_of_list.in(mesh.cells[c]);
        if (!has_side[corners]) continue;
        for (std::size_t k = 0; k < Sides; ++k) {
            if ((corners & corners_of(sides[k])) != corners_of(sides[k])) continue;
            std::array<VertexIndex, N> vertices;
            for (std::size_t j = 0; j < N; ++j) vertices[j] = mesh.cells[c][sides[k][j]];
            buckets.find(vertices, [&](I i) {
                of_cells[i.value()] = true;
                met(c, k, vertices, i);
            });
        }
    }
    WrongEntry<I> wrong;
    const auto stray = std::ranges::find(of_cells, false);
    if (stray != of_cells.end()) {
        wrong.entry = I{static_cast<std::size_t>(stray - of_cells.begin())};
    }
    if (markers.empty()) return wrong;
    buckets.for_each_repeated([&](I first, I again) {
        if (markers[first] != markers[again] && again < wrong.entry) wrong = {again, first};
    });
    return wrong;
}

/// Returns the side of its face k on which a positive cell lies; the face has these vertices.
bool lies_on_even_side(const FacetVertices& face, std::size_t k) {
    const auto& [a, b, c] = face;
    const bool is_even = (a < b) == ((b < c) == (a < c));
    return is_even == (k % 2 == 0);
}

/// Returns the first cell on this side of a face with these vertices, in any order.
CellIndex first_on_side(const Mesh& mesh, FacetVertices face, bool even) {
    std::ranges::sort(face);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (std::size_t k = 0; k < cell_faces.size(); ++k) {
            FacetVertices other;
            for (std::size_t j = 0; j < 3; ++j) other[j] = mesh.cells[c][cell_faces[k][j]];
            if (lies_on_even_side(other, k) != even) continue;
            std::ranges::sort(other);
            if (other == face) return c;
        }
    }
    return CellIndex::none();
}

}  // namespace

WrongFacets find_wrong_facets(const Mesh& mesh) {
    WrongFacets wrong;
    bool even = false;
    std::vector<bool> has_cell(2 * mesh.facets.size(), false);  // for each side of a facet
    const auto met = [&](CellIndex c, std::size_t k, const FacetVertices& vertices, FacetIndex i) {
        const bool is_even = lies_on_even_side(vertices, k);
        const std::size_t side = 2 * std::size_t{i.value()} + (is_even ? 1 : 0);
        if (has_cell[side] && wrong.overlap.cell.is_none()) {
            wrong.overlap.cell = c;
            wrong.common = i;
            even = is_even;
        }
        has_cell[side] = true;
    };
    wrong.tagged = find_wrong(mesh, mesh.facets, mesh.facet_markers, cell_faces, met);
    if (!wrong.overlap.cell.is_none()) {
        wrong.overlap.earlier = first_on_side(mesh, mesh.facets[wrong.common], even);
    }
    return wrong;
}

WrongEntry<EdgeIndex> find_wrong_edge(const Mesh& mesh) {
    const auto ignored = [](auto&&...) {};
    return find_wrong(mesh, mesh.edges, mesh.edge_markers, cell_edges, ignored);
}

}  // namespace octetra
