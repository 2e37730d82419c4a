#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "collective.hpp"

namespace octetra::python {
namespace {

py::array boundary_vertices(Mesh& mesh, const Arguments& arguments) {
    return booleans(
        mesh.ask(arguments, [](const od::AdaptiveMesh& now) { return now.boundary_vertices(); }));
}

/// Collective. All ranks must pass the same arguments, or their sets would differ.
py::array vertices_of(Mesh& mesh, const Arguments& arguments) {
    bool is_group = false;
    std::string group;
    Marker marker = 0;
    int dimension = 0;
    std::string text;
    convert_on_each(mesh.processes(), [&] {
        const auto [given, of_entities] = arguments.values<2>();
        dimension = integer_from<std::int32_t>("dimension", of_entities);
        is_group = py::isinstance<py::str>(given);
        if (is_group) {
            group = string_from("marker", given);
            text = fmt::format("'{}'", group);
        } else {
            marker = integer_from<Marker>("marker", given, ", or the name of a group");
            text = fmt::format("{} of dimension {}", marker, dimension);
        }
    });
    check_same(mesh.processes(), text, "marker or group");
    return booleans(mesh.ask([&](const od::AdaptiveMesh& now) {
        return is_group ? now.vertices_of(group) : now.vertices_of(marker, dimension);
    }));
}

py::array vertex_markers(Mesh& mesh, const Arguments& arguments) {
    return array_of(
        mesh.ask(arguments, [](const od::AdaptiveMesh& now) { return now.vertex_markers(); }));
}

}  // namespace

void bind_vertex_sets(MeshClass& mesh) {
    def_method(mesh, "boundary_vertices", "", &boundary_vertices,
               "Collective. bool (vertices,): whether each vertex is on the boundary of the whole "
               "mesh. Complete on all ranks, in contrast to the vertices of boundary(), which lack "
               "those whose boundary faces are all on other ranks.");
    def_method(mesh, "vertices_of", "marker, *, dimension=2", &vertices_of,
               "Collective. bool (vertices,): whether each vertex belongs to a tagged facet with a "
               "marker. Complete on all ranks, in contrast to the vertices of `facets`, which lack "
               "those whose facets are all on other ranks.\n\n"
               "marker: an integer, or the name of a group, of any dimension. dimension: 2 for "
               "facets, 1 for tagged edges, 3 for cells by their region tag, 0 for the markers of "
               "the vertices themselves. The arguments must be the same on all ranks.");
    def_method(mesh, "vertex_markers", "", &vertex_markers,
               "Collective. int32 (vertices,): the markers of this rank's vertices, as in files, "
               "or (0,) if the input has none.");
}

}  // namespace octetra::python
