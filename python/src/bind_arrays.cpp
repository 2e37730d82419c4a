#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <mpi.h>
#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/mpi.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"

namespace octetra::python {
namespace {

/// A view of an array of the mesh, whose indices must fit into int32.
auto view_of(Mesh::Array array, auto span_of) {
    return [=](Mesh& mesh) {
        const auto span = span_of(mesh.now());
        constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
        if (mesh.vertex_count() > most || mesh.cell_count() > most) {
            throw SystemError("a rank has more than 2,147,483,647 vertices or cells");
        }
        return view(span, mesh.hold(array));
    };
}

void bind_part(MeshClass& mesh) {
    using M = od::AdaptiveMesh;
    mesh.def_property_readonly("points",
                               view_of(Mesh::points, [](const M& m) { return m.points(); }),
                               "float64 (vertices, 3): the coordinates of this rank's vertices.")
        .def_property_readonly(
            "cells", view_of(Mesh::cells, [](const M& m) { return m.cells(); }),
            "int32 (cells, 4): the vertices of this rank's cells, positively oriented.")
        .def_property_readonly("facets",
                               view_of(Mesh::facets, [](const M& m) { return m.facets(); }),
                               "int32 (facets, 3): the vertices of this rank's tagged facets, in "
                               "the order of files, which is no orientation: see "
                               "oriented_facets(). Each facet is on one rank.")
        .def_property_readonly(
            "edges", view_of(Mesh::edges, [](const M& m) { return m.edges(); }),
            "int32 (edges, 2): the vertices of this rank's tagged edges. Each edge is on one rank.")
        .def_property_readonly(
            "vertex_numbers",
            view_of(Mesh::vertex_numbers, [](const M& m) { return m.vertex_numbers(); }),
            "int64 (vertices,): the numbers of this rank's vertices in the whole mesh, which are "
            "those in files.")
        .def_property_readonly(
            "roots", view_of(Mesh::roots, [](const M& m) { return m.roots(); }),
            "int64 (roots,): the numbers of the input cells whose descendants this rank has, "
            "ascending.");
}

std::vector<std::tuple<int, Marker, std::string>> group_names(const Mesh& mesh) {
    std::vector<std::tuple<int, Marker, std::string>> names;
    for (const GroupName& group : mesh.now().group_names()) {
        names.emplace_back(group.dimension, group.tag, group.name);
    }
    return names;
}

void bind_tags(MeshClass& mesh) {
    mesh.def_property_readonly(
            "regions", [](const Mesh& m) { return array_of(m.now().regions()); },
            "int32 (cells,): region tags, or (0,) if the input has none. Computed on access.")
        .def_property_readonly(
            "facet_markers", [](const Mesh& m) { return array_of(m.now().facet_markers()); },
            "int32 (facets,): facet markers, or (0,) if the input has none. Computed on access.")
        .def_property_readonly(
            "edge_markers", [](const Mesh& m) { return array_of(m.now().edge_markers()); },
            "int32 (edges,): edge markers, or (0,) if the input has none. Computed on access.")
        .def_property_readonly(
            "root_of_cells", [](const Mesh& m) { return array_of(m.now().root_of_cells()); },
            "int32 (cells,): for each cell the index of its root in `roots`. Computed on access.")
        .def_property_readonly("group_names", &group_names,
                               "[(dimension, tag, name)]: the names of groups of entities in the "
                               "input file; dimension 3 for cells, 2 for facets, 1 for edges and 0 "
                               "for vertices. The same on all ranks.");
}

/// An array of shape (vertices, attributes).
py::array vertex_attributes(const Mesh& mesh) {
    const auto values = mesh.now().vertex_attributes();
    const auto columns = static_cast<py::ssize_t>(mesh.now().attributes_per_vertex());
    return array_of(std::vector<double>(values.begin(), values.end()))
        .attr("reshape")(static_cast<py::ssize_t>(mesh.vertex_count()), columns);
}

/// The communicator of the mesh as an object of mpi4py, which does not own it.
py::object comm_of_mesh(const Mesh& mesh) {
    const auto handle = MPI_Comm_c2f(od::comm_of(mesh.processes()));
    return py::module_::import("mpi4py.MPI").attr("Comm").attr("f2py")(handle);
}

void bind_numbers(MeshClass& mesh) {
    def_method(
        mesh, "cell_numbers", "",
        [](Mesh& m, const Arguments& arguments) {
            return array_of(m.ask(arguments, [](const auto& now) { return now.cell_numbers(); }));
        },
        "Collective. int64 (cells,): the numbers of this rank's cells in the whole mesh, which are "
        "those in files and the same on any number of ranks.");
    def_method(
        mesh, "vertex_volumes", "",
        [](Mesh& m, const Arguments& arguments) {
            return array_of(m.ask(arguments, [](const auto& now) { return now.vertex_volumes(); }));
        },
        "Collective. float64 (vertices,): a quarter of the total volume of the cells at each "
        "vertex, those of other ranks included: the lumped mass matrix of P1 elements.");
    mesh.def_property_readonly(
            "vertex_attributes", &vertex_attributes,
            "float64 (vertices, attributes): the nodal attributes of the input; a midpoint has the "
            "mean of the ends of its edge. Computed on access.")
        .def_property_readonly(
            "comm", &comm_of_mesh,
            "mpi4py.MPI.Comm: the communicator of the mesh, with the ranks of the `comm` that the "
            "mesh was created with, in the same order. It is valid as long as the mesh exists; "
            "comm.Dup() returns an independent one.");
}

}  // namespace

void bind_arrays(MeshClass& mesh) {
    bind_part(mesh);
    bind_tags(mesh);
    bind_numbers(mesh);
    def_method(
        mesh, "count_cells", "",
        [](Mesh& m, const Arguments& arguments) {
            return m.ask(arguments, [](const od::AdaptiveMesh& now) {
                return now.processes().sum(now.cells().size());
            });
        },
        "Collective. int: the number of cells of the whole mesh.");
    mesh.def_property_readonly(
            "rank", [](const Mesh& m) { return m.processes().rank(); },
            "int: the rank of this process in the communicator of the mesh.")
        .def_property_readonly(
            "rank_count", [](const Mesh& m) { return m.processes().size(); },
            "int: the number of ranks in the communicator of the mesh.")
        .def_property_readonly(
            "vertex_count", [](const Mesh& m) { return m.now().vertex_count(); },
            "int: the number of vertices of the whole mesh.")
        .def("__repr__", [](const Mesh& m) {
            return "<octetra.Mesh: " + std::to_string(m.now().cells().size()) + " cells and " +
                   std::to_string(m.now().points().size()) + " vertices on rank " +
                   std::to_string(m.processes().rank()) + " of " +
                   std::to_string(m.processes().size()) + ">";
        });
}

}  // namespace octetra::python
