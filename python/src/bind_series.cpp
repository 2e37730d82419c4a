#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "bind.hpp"
#include "fields.hpp"
#include "held_series.hpp"

namespace octetra::python {
namespace {

std::unique_ptr<Series> begun(const Arguments& arguments) {
    const od::Communicator processes = processes_of(arguments.find("comm", 1));
    const std::filesystem::path path =
        common_path(processes, [&] { return path_from("path", arguments.values<2>()[0]); });
    return without_gil([&] { return std::make_unique<Series>(processes, path); });
}

/// Collective. All ranks take the time of the first rank, so that all append the mesh or none.
void append_to(Mesh& mesh, const Arguments& arguments) {
    Series* series = nullptr;
    double time = 0;
    std::vector<od::Field> fields;
    convert_on_each(mesh.processes(), [&] {
        const auto [itself, given, on_vertices, on_cells] = arguments.values<4>();
        series = &instance_from<Series>("series", itself, "an octetra.MeshSeries");
        if (series->processes().size() != mesh.processes().size() ||
            series->processes().rank() != mesh.processes().rank()) {
            throw InputError("the series and the mesh have different communicators");
        }
        if (!series->is_open()) throw InputError("the series has been committed or discarded");
        time = number_from("time", given);
        fields = fields_of(on_vertices, on_cells, mesh.vertex_count(), mesh.cell_count());
    });
    const Series::Lent lent(*series);
    mesh.ask([&](const od::AdaptiveMesh& now) {
        now.append_to(*lent, now.processes().of_rank(0, time), fields);
    });
}

std::string commit(Series& series) {
    std::string lost = [&] {
        const Series::Lent lent(series);
        return without_gil([&] { return (*lent).commit(); });
    }();
    series.give_up();  // the series is finished: nothing is discarded
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
    py::class_<Series> series(
        module, "MeshSeries",
        "MeshSeries(path, comm=None): a series of meshes, each with its time, in one .vtkhdf file, "
        "whose content does not depend on the number of ranks. Collective.\n\n"
        "Mesh.append_to() appends a mesh; commit() moves the file to its path. Until then the file "
        "has a temporary name beside the path, and an existing file takes space as well. A with "
        "statement commits the series at its end, and discards it if an exception is raised. comm: "
        "an mpi4py communicator; None means all ranks.");
    series
        .def(py::init([signature = Signature("MeshSeries", "path, comm=None")](
                          const py::args& positional, const py::kwargs& named) {
                 return begun(Arguments(signature, positional, named));
             }),
             "__init__(self, path, comm=None)\n--\n\nCollective. Creates the file.")
        .def(
            "__enter__", [](Series& self) -> Series& { return self; },
            py::return_value_policy::reference)
        .def("__exit__", &end);
    def_method(
        series, "commit", "",
        [](Series& self, const Arguments& arguments) {
            convert_on_each(self.processes(), [&] { arguments.check(); });
            return commit(self);
        },
        "Collective. Moves the file to its path; no mesh can be appended afterwards. Returns a "
        "note of the data that the format cannot hold, or ''.");
    def_method(mesh, "append_to", "series, time, *, vertex_fields=None, cell_fields=None",
               &append_to,
               "Collective. Appends the mesh to a MeshSeries, with fields as for write(). time: a "
               "number greater than that of the previous mesh; all ranks take the time of the "
               "first rank.");
}

}  // namespace octetra::python
