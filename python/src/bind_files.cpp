#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/partition.hpp>

#include "bind.hpp"
#include "fields.hpp"

namespace octetra::python {
namespace {

using Path = std::filesystem::path;

/// Collective. A mesh that make(processes, path, partition) makes without the GIL.
MeshPointer made(const py::object& comm, const py::object& given, const std::string& method,
                 auto&& make) {
    const od::Communicator processes = processes_of(comm);
    const Path path = common_path(processes, given);
    od::Partition partition;
    convert_on_each(processes, [&] { partition = od::parse_partition(method); });
    return without_gil([&] { return std::make_shared<Mesh>(make(processes, path, partition)); });
}

/// A checkpoint is a mesh as any other.
MeshPointer read(const py::object& path, const py::object& comm, const std::string& partition) {
    return made(comm, path, partition, [](const auto& processes, const auto& from, const auto& by) {
        return is_checkpoint(from) ? od::AdaptiveMesh::load(processes, from, by)
                                   : od::AdaptiveMesh::read(processes, from, by);
    });
}

MeshPointer load(const py::object& path, const py::object& comm, const std::string& partition,
                 std::vector<od::Field>* fields) {
    return made(comm, path, partition,
                [&](const auto& processes, const auto& from, const auto& by) {
                    return od::AdaptiveMesh::load(processes, from, by, fields);
                });
}

std::tuple<MeshPointer, py::dict, py::dict> load_with_fields(const py::object& path,
                                                             const py::object& comm,
                                                             const std::string& partition) {
    std::vector<od::Field> fields;
    MeshPointer mesh = load(path, comm, partition, &fields);
    py::dict on_vertices = dict_of(fields, FieldOn::vertices);
    return {std::move(mesh), std::move(on_vertices), dict_of(std::move(fields), FieldOn::cells)};
}

/// Collective. What a mesh writes into a file, with fields.
auto written(Mesh& mesh, const py::object& given, const py::object& on_vertices,
             const py::object& on_cells, auto&& write) {
    const Path path = common_path(mesh.processes(), given);
    std::vector<od::Field> fields;
    convert_on_each(mesh.processes(), [&] {
        fields = fields_of(on_vertices, on_cells, mesh.vertex_count(), mesh.cell_count());
    });
    return mesh.ask([&](const od::AdaptiveMesh& now) { return write(now, path, fields); });
}

std::string write(Mesh& mesh, const py::object& path, const py::object& vertex_fields,
                  const py::object& cell_fields) {
    return written(mesh, path, vertex_fields, cell_fields,
                   [](const od::AdaptiveMesh& now, const Path& to, const auto& fields) {
                       if (!is_checkpoint(to)) return now.write(to, fields);
                       now.save(to, fields);
                       return std::string();
                   });
}

/// None where nothing is given.
std::optional<SavedState> state_of(const py::object& time, const py::object& step,
                                   const py::object& text) {
    if (time.is_none() && step.is_none() && text.is_none()) return std::nullopt;
    SavedState state;
    if (!time.is_none()) state.time = time.cast<double>();
    if (!step.is_none()) state.step = step.cast<std::int64_t>();
    if (!text.is_none()) state.text = text.cast<std::string>();
    return state;
}

/// The time, step and text that save() wrote into a checkpoint; None if there are none.
py::object saved_state(const Path& path) {
    const std::optional<SavedState> state = read_checkpoint_facts(path).state;
    if (!state) return py::none();
    py::dict all;
    all["time"] = state->time;
    all["step"] = state->step;
    all["text"] = state->text;
    return all;
}

void save(Mesh& mesh, const py::object& path, const py::object& vertex_fields,
          const py::object& cell_fields, const py::object& time, const py::object& step,
          const py::object& text) {
    std::optional<SavedState> state;
    convert_on_each(mesh.processes(), [&] { state = state_of(time, step, text); });
    written(mesh, path, vertex_fields, cell_fields,
            [&](const od::AdaptiveMesh& now, const Path& to, const auto& fields) {
                if (!is_checkpoint(to)) {
                    throw InputError(fmt::format(
                        "{}: save() writes a checkpoint, which is named .octetra; write() writes "
                        "files of other formats",
                        to.native()));
                }
                now.save(to, fields, state);
            });
}

}  // namespace

void bind_files(py::module_& module, MeshClass& mesh) {
    const py::arg path("path");
    const py::arg_v comm = py::arg("comm") = py::none();
    const py::arg_v partition = py::arg("partition") = "rcb";
    module.def(
        "read", &read, path, comm, py::kw_only(), partition,
        "Collective. A mesh from a file (.ele, .mesh, .meshb, .msh, or .octetra as by load()), "
        "shared out over the ranks of comm, an mpi4py communicator; None means all ranks. "
        "partition: 'rcb', "
        "'lepp', 'dual', 'block', 'random:SEED' or 'file:PATH'.");
    module.def(
        "load",
        [](const py::object& from, const py::object& ranks, const std::string& by) {
            return load(from, ranks, by, nullptr);
        },
        path, comm, py::kw_only(), partition,
        "Collective. A mesh that save() has written, on any number of ranks, with its history. It "
        "goes on as if it had never been away.");
    module.def("load_with_fields", &load_with_fields, path, comm, py::kw_only(), partition,
               "Collective. A mesh that save() has written, and the fields that were saved with "
               "it: the mesh, those of "
               "vertices and those of cells, {name: (n,) or (n, components)}.");
    const py::arg_v vertex_fields = py::arg("vertex_fields") = py::none();
    const py::arg_v cell_fields = py::arg("cell_fields") = py::none();
    mesh.def("write", &write, path, py::kw_only(), vertex_fields, cell_fields,
             "Collective. Writes a file, the same on any number of ranks; its extension says of "
             "which format. Fields, {name: values}, go into .vtu, .pvtu, .vtkhdf, .xdmf and "
             ".octetra, and beside a Medit mesh into a .sol or .solb: float64, float32, int32 or "
             "int64 of shape (vertices, ...) or (cells, ...). Returns what the "
             "format could not hold, or ''.")
        .def("save", &save, path, py::kw_only(), vertex_fields, cell_fields,
             py::arg("time") = py::none(), py::arg("step") = py::none(),
             py::arg("text") = py::none(),
             "Collective. Writes a checkpoint, .octetra: the input, what each step did, and "
             "fields, as of write(). The same file on any number of ranks. time, a number, step, "
             "a whole number, and text, such as JSON, are the program's own, the same on all "
             "ranks: saved_state() has them again.");
    module.def("saved_state", &saved_state, path,
               "What save() was given with this checkpoint: {'time': float, 'step': int, 'text': "
               "str}, or None where it was given nothing. Reads the table of the file alone; not "
               "collective.");
}

}  // namespace octetra::python
