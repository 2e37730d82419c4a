#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "bind.hpp"
#include "fields.hpp"
#include "held_series.hpp"

namespace octetra::python {
namespace {

std::unique_ptr<Series> begun(const py::object& given, const py::object& comm) {
    const od::Communicator processes = processes_of(comm);
    const std::filesystem::path path = common_path(processes, given);
    return without_gil([&] { return std::make_unique<Series>(processes, path); });
}

/// The first rank's time counts: then all ranks take it, or none.
void append_to(Mesh& mesh, Series& series, const py::object& given, const py::object& on_vertices,
               const py::object& on_cells) {
    double time = 0;
    std::vector<od::Field> fields;
    convert_on_each(mesh.processes(), [&] {
        if (series.processes().size() != mesh.processes().size() ||
            series.processes().rank() != mesh.processes().rank()) {
            throw InputError("the series and the mesh are on different ranks");
        }
        if (!series.is_open()) throw InputError("the series is committed, or given up");
        time = given.cast<double>();
        fields = fields_of(on_vertices, on_cells, mesh.vertex_count(), mesh.cell_count());
    });
    const Series::Lent lent(series);
    mesh.ask([&](const od::AdaptiveMesh& now) {
        now.append_to(*lent, now.processes().of_rank(0, time), fields);
    });
}

std::string commit(Series& series) {
    std::string lost = [&] {
        const Series::Lent lent(series);
        return without_gil([&] { return (*lent).commit(); });
    }();
    series.give_up();  // what is left is nothing
    return lost;
}

/// At the end of a with statement.
void end(Series& series, const py::object& type, const py::object&, const py::object&) {
    if (type.is_none() && series.is_open()) {
        (void)commit(series);
    } else {
        series.give_up();
    }
}

}  // namespace

void bind_series(py::module_& module, MeshClass& mesh) {
    py::class_<Series>(
        module, "MeshSeries",
        "MeshSeries(path, comm=None): meshes one after the other, each at a time, in one .vtkhdf "
        "file, the same on any number of ranks. Collective. Mesh.append_to() appends to it, and "
        "commit() puts the file in its place; until then it is written beside, and takes its space "
        "twice. In a with statement it is committed in the end, or given up where the statement "
        "raises.")
        .def(py::init(&begun), py::arg("path"), py::arg("comm") = py::none())
        .def("commit", &commit,
             "Collective. Puts the file in its place; nothing can be appended any more. Returns "
             "what "
             "is left out, or ''.")
        .def(
            "__enter__", [](Series& series) -> Series& { return series; },
            py::return_value_policy::reference)
        .def("__exit__", &end);
    mesh.def(
        "append_to", &append_to, py::arg("series"), py::arg("time"), py::kw_only(),
        py::arg("vertex_fields") = py::none(), py::arg("cell_fields") = py::none(),
        "Collective. Appends the mesh to a MeshSeries, with fields as of write(). time: greater "
        "than those before; the first rank's counts.");
}

}  // namespace octetra::python
