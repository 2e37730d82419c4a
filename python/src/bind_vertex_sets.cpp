#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "collective.hpp"

namespace octetra::python {
namespace {

py::array boundary_vertices(Mesh& mesh) {
    return booleans(mesh.ask([](const od::AdaptiveMesh& now) { return now.boundary_vertices(); }));
}

/// Collective. All ranks must pass the same, or their sets would be of different entities.
py::array vertices_of(Mesh& mesh, const std::variant<Marker, std::string>& which, int dimension) {
    const Marker* const marker = std::get_if<Marker>(&which);
    const std::string words = marker != nullptr
                                  ? fmt::format("{} of dimension {}", *marker, dimension)
                                  : fmt::format("'{}'", std::get<std::string>(which));
    check_same(mesh.processes(), words, "marker or group");
    return booleans(mesh.ask([&](const od::AdaptiveMesh& now) {
        return marker != nullptr ? now.vertices_of(*marker, dimension)
                                 : now.vertices_of(std::get<std::string>(which));
    }));
}

py::array vertex_markers(Mesh& mesh) {
    return array_of(mesh.ask([](const od::AdaptiveMesh& now) { return now.vertex_markers(); }));
}

}  // namespace

void bind_vertex_sets(MeshClass& mesh) {
    mesh.def("boundary_vertices", &boundary_vertices,
             "Collective. bool (vertices,): is the vertex on the boundary of the whole mesh? "
             "Complete on all ranks, whereas the vertices of boundary() lack those of which only "
             "another rank has a boundary face.")
        .def("vertices_of", &vertices_of, py::arg("marker"), py::kw_only(),
             py::arg("dimension") = 2,
             "Collective. bool (vertices,): is it a vertex of a tagged facet with this marker? "
             "dimension: 2 for facets, 1 for tagged edges, 3 for cells by their region tag, 0 for "
             "the vertices' own markers. marker may be the name of a group, whose entities are "
             "then meant, of whatever dimension. The same on all ranks. Complete on all ranks, "
             "whereas the vertices of `facets` lack those of which only another rank has the "
             "facet.")
        .def("vertex_markers", &vertex_markers,
             "Collective. int32 (vertices,): the markers of this rank's vertices, as files show "
             "them, or (0,) where the input has none.");
}

}  // namespace octetra::python
