#include "fuzz/check_readers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <octetra/core/orientation.hpp>

#include "support/temporary_folder.hpp"

namespace octetra::test {
namespace {

template <std::size_t N>
std::array<VertexIndex, N> sorted(std::array<VertexIndex, N> vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

bool is_finite(const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool is_none_or_one_each(std::size_t markers, std::size_t entities) {
    return markers == 0 || markers == entities;
}

template <class I, std::size_t N>
bool all_in_range(const IndexVector<I, std::array<VertexIndex, N>>& list, const Mesh& mesh) {
    return std::ranges::all_of(list, [&](const auto& vertices) {
        return std::ranges::all_of(vertices,
                                   [&](VertexIndex v) { return v < mesh.points.end_index(); });
    });
}

template <class I, std::size_t N>
bool all_different(const IndexVector<I, std::array<VertexIndex, N>>& list) {
    return std::ranges::all_of(list, [](const auto& vertices) {
        const auto in_order = sorted(vertices);
        return std::adjacent_find(in_order.begin(), in_order.end()) == in_order.end();
    });
}

/// Returns whether every entity of the list is a face or edge of some cell.
template <class I, std::size_t N, std::size_t Sides>
bool all_of_cells(const IndexVector<I, std::array<VertexIndex, N>>& list, const Mesh& mesh,
                  const std::array<std::array<std::uint8_t, N>, Sides>& sides) {
    std::set<std::array<VertexIndex, N>> of_cells;
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& side : sides) {
            std::array<VertexIndex, N> vertices;
            for (std::size_t k = 0; k < N; ++k) vertices[k] = cell[side[k]];
            of_cells.insert(sorted(vertices));
        }
    }
    return std::ranges::all_of(
        list, [&](const auto& vertices) { return of_cells.contains(sorted(vertices)); });
}

bool has_repetition(const Mesh& mesh) {
    std::set<CellVertices> cells;
    return !std::ranges::all_of(mesh.cells,
                                [&](const auto& c) { return cells.insert(sorted(c)).second; });
}

/// Returns whether an entity of the list occurs twice, with different markers.
template <class I, std::size_t N>
bool has_two_markers(const IndexVector<I, std::array<VertexIndex, N>>& list,
                     const IndexVector<I, Marker>& markers) {
    std::map<std::array<VertexIndex, N>, Marker> first;
    for (I i{0}; !markers.empty() && i < list.end_index(); ++i) {
        if (first.emplace(sorted(list[i]), markers[i]).first->second != markers[i]) return true;
    }
    return false;
}

/// Returns whether a tagged facet has more than one cell on either side.
bool has_overlap_at_facet(const Mesh& mesh) {
    std::map<FacetVertices, std::array<int, 2>> cells_at_sides;
    for (const FacetVertices& facet : mesh.facets) cells_at_sides[sorted(facet)] = {};
    for (const CellVertices& cell : mesh.cells) {
        for (const VertexIndex apex : cell) {
            FacetVertices face;
            std::ranges::copy_if(sorted(cell), face.begin(),
                                 [&](VertexIndex v) { return v != apex; });
            const auto sides = cells_at_sides.find(face);
            if (sides == cells_at_sides.end()) continue;
            const auto& p = mesh.points;
            const bool above = orientation(p[face[0]], p[face[1]], p[face[2]], p[apex]) > 0;
            if (++sides->second[above ? 1 : 0] > 1) return true;
        }
    }
    return false;
}

bool is_positive(const CellVertices& cell, const Mesh& mesh) {
    const auto& points = mesh.points;
    return orientation(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]) > 0;
}

constexpr std::array<NamedCheck, 12> all_checks{{{"tetgen", check_tetgen},
                                                 {"medit", check_medit},
                                                 {"meshb", check_meshb},
                                                 {"gmsh", check_gmsh},
                                                 {"sol", check_sol},
                                                 {"solb", check_solb},
                                                 {"gmsh_data", check_gmsh_data},
                                                 {"expression", check_expression},
                                                 {"maps", check_maps},
                                                 {"cell_list", check_cell_list},
                                                 {"part_file", check_part_file},
                                                 {"checkpoint", check_checkpoint}}};

}  // namespace

std::span<const NamedCheck> reader_checks() { return all_checks; }

std::string broken_invariant(const Mesh& mesh, bool only_syntax) {
    if (mesh.index_base > 1) return "the index base is neither 0 nor 1";
    if (!is_none_or_one_each(mesh.point_markers.size(), mesh.points.size()) ||
        !is_none_or_one_each(mesh.regions.size(), mesh.cells.size()) ||
        !is_none_or_one_each(mesh.facet_markers.size(), mesh.facets.size()) ||
        !is_none_or_one_each(mesh.edge_markers.size(), mesh.edges.size()) ||
        mesh.point_attributes.size() != mesh.points.size() * mesh.attributes_per_point) {
        return "a list is of another length than what it belongs to";
    }
    if (!std::ranges::all_of(mesh.points, is_finite)) return "a coordinate is not finite";
    if (!std::ranges::all_of(mesh.point_attributes, [](double a) { return std::isfinite(a); })) {
        return "an attribute is not finite";
    }
    if (!all_in_range(mesh.cells, mesh) || !all_in_range(mesh.facets, mesh) ||
        !all_in_range(mesh.edges, mesh)) {
        return "a vertex number is out of range";
    }
    if (only_syntax) return {};
    if (!all_different(mesh.cells) || !all_different(mesh.facets) || !all_different(mesh.edges)) {
        return "an entity has a vertex twice";
    }
    if (!std::ranges::all_of(mesh.cells, [&](const auto& c) { return is_positive(c, mesh); })) {
        return "a cell is not positively oriented";
    }
    if (!all_of_cells(mesh.facets, mesh, cell_faces)) return "a facet is of no cell";
    if (!all_of_cells(mesh.edges, mesh, cell_edges)) return "an edge is of no cell";
    if (has_repetition(mesh)) return "two cells have the same vertices";
    if (has_two_markers(mesh.facets, mesh.facet_markers)) return "a facet has two markers";
    if (has_two_markers(mesh.edges, mesh.edge_markers)) return "an edge has two markers";
    if (has_overlap_at_facet(mesh)) return "two cells are on the same side of a facet";
    return {};
}

void check_message(const std::string& message, const std::filesystem::path& folder) {
    const auto fail = [&] { throw BrokenPromise("unfit for a message: " + message); };
    if (!std::ranges::all_of(message, [](char c) { return c >= ' ' && c <= '~'; })) fail();
    if (!message.starts_with(folder.native() + "/")) fail();
    const std::size_t colon = message.find(':', folder.native().size());
    if (colon == std::string::npos) fail();

    constexpr std::string_view at_byte = ": at byte ";
    if (message.substr(colon).starts_with(at_byte)) {
        const std::string_view rest = std::string_view(message).substr(colon + at_byte.size());
        std::uintmax_t byte = 0;
        const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), byte);
        const std::string_view what = rest.substr(static_cast<std::size_t>(stop - rest.data()));
        if (error != std::errc{} || !what.starts_with(": ") || what.size() == 2) fail();
        if (byte > std::filesystem::file_size(message.substr(0, colon))) fail();
        return;
    }
    std::size_t line = 0;
    const char* const end = message.data() + message.size();
    const auto [stop, error] = std::from_chars(message.data() + colon + 1, end, line);
    if (error != std::errc{}) return;  // refers to the file as a whole
    const std::string content = content_of(message.substr(0, colon));
    const auto line_ends = static_cast<std::size_t>(std::ranges::count(content, '\n'));
    if (stop == end || *stop != ':' || line == 0 || line > line_ends + 1) fail();
}

}  // namespace octetra::test
