#include <octetra/core/cell_quantities.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <octetra/core/error.hpp>
#include <octetra/core/triangle_tree.hpp>

namespace octetra {
namespace {

constexpr std::size_t names_shown = 20;

/// Returns up to names_shown names, separated by commas.
std::string list_of(const auto& names) {
    std::string list;
    std::size_t count = 0;
    for (const auto& name : names) {
        if (count == names_shown) return list + ", ...";
        list += fmt::format("{}{}", count == 0 ? "" : ", ", name);
        ++count;
    }
    return list;
}

/// Returns for each cell 1 if one of its faces is no face of another cell, otherwise 0.
std::vector<double> boundary_of(const Mesh& mesh) {
    struct Face {
        FacetVertices vertices;
        CellIndex cell;
    };
    std::vector<Face> faces;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        for (const auto& [i, j, k] : cell_faces) {
            FacetVertices face{mesh.cells[c][i], mesh.cells[c][j], mesh.cells[c][k]};
            std::ranges::sort(face);
            faces.push_back({face, c});
        }
    }
    std::ranges::sort(faces, {}, &Face::vertices);
    std::vector<double> values(mesh.cells.size(), 0);
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        while (end < faces.size() && faces[end].vertices == faces[begin].vertices) ++end;
        if (end - begin == 1) values[faces[begin].cell.value()] = 1;
    }
    return values;
}

double extent_of(const Mesh& mesh) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double extent = 0;
    for (double Point::*axis : {&Point::x, &Point::y, &Point::z}) {
        double low = infinity;
        double high = -infinity;
        for (const Point& p : mesh.points) {
            low = std::min(low, p.*axis);
            high = std::max(high, p.*axis);
        }
        extent = std::max(extent, high / 2 - low / 2);
    }
    return extent;
}

std::vector<double> distances_of(const Term& term, const Mesh& mesh) {
    const std::vector<Marker> markers = markers_of(term.name, mesh.group_names);
    const int exponent = exponent_of_extent(extent_of(mesh));
    std::vector<Triangle> triangles;
    for (FacetIndex f{0}; f < mesh.facet_markers.end_index(); ++f) {
        if (std::ranges::find(markers, mesh.facet_markers[f]) == markers.end()) continue;
        const auto& [a, b, c] = mesh.facets[f];
        triangles.push_back({scaled_by(mesh.points[a], exponent),
                             scaled_by(mesh.points[b], exponent),
                             scaled_by(mesh.points[c], exponent)});
    }
    if (triangles.empty()) {
        refuse_marker(term, {mesh.facet_markers.begin(), mesh.facet_markers.end()},
                      mesh.group_names);
    }
    const TriangleTree tree(std::move(triangles));
    std::vector<double> distances;
    for (const auto& [a, b, c, d] : mesh.cells) {
        const Point p = centroid({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
        const double squared = tree.least_squared_distance(scaled_by(p, exponent));
        distances.push_back(std::scalbn(std::sqrt(squared), exponent));
    }
    return distances;
}

}  // namespace

std::vector<double> generations_of(std::span<const CellVertices> cells, std::size_t first_midpoint,
                                   std::span<const EdgeVertices> midpoint_to_edge) {
    std::vector<double> of_midpoint;
    of_midpoint.reserve(midpoint_to_edge.size());
    const auto generation = [&](VertexIndex v) {
        return v.value() < first_midpoint ? 0 : of_midpoint[v.value() - first_midpoint];
    };
    for (const auto& [a, b] : midpoint_to_edge) {
        of_midpoint.push_back(1 + std::max(generation(a), generation(b)));
    }
    std::vector<double> generations;
    generations.reserve(cells.size());
    for (const auto& [a, b, c, d] : cells) {
        generations.push_back(
            std::max({generation(a), generation(b), generation(c), generation(d)}));
    }
    return generations;
}

std::vector<Marker> markers_of(const std::string& name, std::span<const GroupName> groups) {
    std::vector<Marker> markers;
    Marker number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size()) markers.push_back(number);
    for (const GroupName& group : groups) {
        if (group.dimension == 2 && group.name == name) markers.push_back(group.tag);
    }
    return markers;
}

void refuse_marker(const Term& term, const std::set<Marker>& markers,
                   std::span<const GroupName> groups) {
    if (markers.empty()) {
        throw InputError(fmt::format("{}: the facets of this mesh have no markers", text_of(term)));
    }
    std::vector<std::string> names;
    for (const GroupName& group : groups) {
        if (group.dimension == 2) names.push_back(group.name);
    }
    const bool is_number = term.name.find_first_not_of("-0123456789") == std::string::npos;
    throw InputError(fmt::format("{}: no facet {}; there are {}{}", text_of(term),
                                 is_number ? "has this marker" : "is in a group of this name",
                                 is_number ? list_of(markers) : "the markers " + list_of(markers),
                                 names.empty() ? "" : ", with the names " + list_of(names)));
}

void refuse_field(const Term& term, const std::vector<std::string>& fields) {
    throw InputError(fmt::format("{}: {}", text_of(term),
                                 fields.empty()
                                     ? "this mesh has no fields"
                                     : "there is no such field; there are " + list_of(fields)));
}

int exponent_of_extent(double extent) { return extent > 0 ? std::ilogb(extent) + 2 : 0; }

Point scaled_by(const Point& p, int exponent) {
    return {std::scalbn(p.x, -exponent), std::scalbn(p.y, -exponent), std::scalbn(p.z, -exponent)};
}

TermValues term_values(const Selection& selection, const Mesh& mesh, const RefinementMaps& maps) {
    TermValues values;
    for (const Term& term : external_terms(selection)) {
        switch (term.quantity) {
            case Quantity::generation:
                values.push_back(
                    generations_of(mesh.cells, maps.first_midpoint.value(), maps.midpoint_to_edge));
                break;
            case Quantity::boundary: values.push_back(boundary_of(mesh)); break;
            case Quantity::distance: values.push_back(distances_of(term, mesh)); break;
            case Quantity::background:
            case Quantity::graded:
                throw InputError(fmt::format(
                    "{} cannot be evaluated by the serial reference: use the default engine",
                    text_of(term)));
            default: refuse_field(term, {});
        }
    }
    return values;
}

}  // namespace octetra
