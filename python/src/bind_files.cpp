#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/distributed/partition.hpp>

#include "arguments.hpp"
#include "bind.hpp"
#include "fields.hpp"

namespace octetra::python {
namespace {

using Path = std::filesystem::path;

/// Collective. The mesh that make(processes, path, partition) returns, for functions of Python with
/// the parameters path, comm and partition.
MeshPointer made(const Arguments& arguments, auto&& make) {
    const od::Communicator processes = processes_of(arguments.find("comm", 1));
    std::string partition_name;
    const Path path = common_path(processes, [&] {
        const auto [given, comm, partition] = arguments.values<3>();
        partition_name = string_from("partition", partition);
        return path_from("path", given);
    });
    od::Partition partition;
    convert_on_each(processes, [&] { partition = od::parse_partition(partition_name); });
    return without_gil([&] { return std::make_shared<Mesh>(make(processes, path, partition)); });
}

/// Reads a mesh file or a checkpoint.
MeshPointer read(const Arguments& arguments) {
    return made(arguments, [](const auto& processes, const auto& from, const auto& by) {
        return is_checkpoint(from) ? od::AdaptiveMesh::load(processes, from, by)
                                   : od::AdaptiveMesh::read(processes, from, by);
    });
}

MeshPointer load(const Arguments& arguments, std::vector<od::Field>* fields) {
    return made(arguments, [&](const auto& processes, const auto& from, const auto& by) {
        return od::AdaptiveMesh::load(processes, from, by, fields);
    });
}

std::tuple<MeshPointer, py::dict, py::dict> load_with_fields(const Arguments& arguments) {
    std::vector<od::Field> fields;
    MeshPointer mesh = load(arguments, &fields);
    py::dict on_vertices = dict_of(fields, FieldOn::vertices);
    return {std::move(mesh), std::move(on_vertices), dict_of(std::move(fields), FieldOn::cells)};
}

/// Collective. Writes a file by write(mesh, path, fields). `convert` returns the arguments path,
/// vertex_fields and cell_fields.
auto written(Mesh& mesh, const std::function<std::array<py::object, 3>()>& convert, auto&& write) {
    std::vector<od::Field> fields;
    const Path path = common_path(mesh.processes(), [&] {
        const auto [given, on_vertices, on_cells] = convert();
        fields = fields_of(on_vertices, on_cells, mesh.vertex_count(), mesh.cell_count());
        return path_from("path", given);
    });
    return mesh.ask([&](const od::AdaptiveMesh& now) { return write(now, path, fields); });
}

std::string write(Mesh& mesh, const Arguments& arguments) {
    return written(
        mesh, [&] { return arguments.values<3>(); },
        [](const od::AdaptiveMesh& now, const Path& to, const auto& fields) {
            if (!is_checkpoint(to)) return now.write(to, fields);
            now.save(to, fields);
            return std::string();
        });
}

/// The state to save, or std::nullopt if all arguments are None.
std::optional<SavedState> state_of(const py::object& time, const py::object& step,
                                   const py::object& text) {
    if (time.is_none() && step.is_none() && text.is_none()) return std::nullopt;
    SavedState state;
    if (!time.is_none()) state.time = number_from("time", time);
    if (!step.is_none()) state.step = integer_from<std::int64_t>("step", step);
    if (!text.is_none()) state.text = string_from("text", text);
    return state;
}

py::object saved_state(const Arguments& arguments) {
    const Path path = path_from("path", arguments.values<1>()[0]);
    const std::optional<SavedState> state = read_checkpoint_facts(path).state;
    if (!state) return py::none();
    py::dict all;
    all["time"] = state->time;
    all["step"] = state->step;
    all["text"] = state->text;
    return all;
}

void save(Mesh& mesh, const Arguments& arguments) {
    std::optional<SavedState> state;
    written(
        mesh,
        [&]() -> std::array<py::object, 3> {
            const auto [path, on_vertices, on_cells, time, step, text] = arguments.values<6>();
            state = state_of(time, step, text);
            return {path, on_vertices, on_cells};
        },
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
    const char* const parameters = "path, comm=None, *, partition='rcb'";
    def_function(module, "read", parameters, &read,
                 "Collective. Reads a Mesh from a file: .ele, .mesh, .meshb, .msh, or .octetra as "
                 "load() does.\n\n"
                 "comm: an mpi4py communicator; None means all ranks. partition: the distribution "
                 "of cells to the ranks of comm: 'rcb', 'lepp', 'dual', 'block', 'random:SEED' or "
                 "'file:PATH'.");
    def_function(
        module, "load", parameters, [](const Arguments& given) { return load(given, nullptr); },
        "Collective. Loads a Mesh with its history from a checkpoint of Mesh.save(), on any number "
        "of ranks. Later steps have the same results as if the mesh had not been saved. Parameters "
        "as for read().");
    def_function(module, "load_with_fields", parameters, &load_with_fields,
                 "Collective. Loads a Mesh and the fields saved with it. Returns the mesh, the "
                 "fields on vertices and those on cells, {name: (n,) or (n, components)}. "
                 "Parameters as for read().");
    def_method(mesh, "write", "path, *, vertex_fields=None, cell_fields=None", &write,
               "Collective. Writes a file, whose content does not depend on the number of ranks. "
               "The extension of the path selects the format.\n\n"
               "vertex_fields, cell_fields: {name: values}, of float64, float32, int32 or int64 "
               "and of shape (vertices, ...) or (cells, ...); for .vtu, .pvtu, .vtkhdf, .xdmf and "
               ".octetra, and for Medit meshes, beside which they are written as .sol or .solb. "
               "Returns a note of the data that the format cannot hold, or ''.");
    def_method(mesh, "save",
               "path, *, vertex_fields=None, cell_fields=None, time=None, step=None, text=None",
               &save,
               "Collective. Writes a checkpoint, .octetra: the input, the history, and fields as "
               "for write(). The content does not depend on the number of ranks.\n\n"
               "time, step, text: the state of the program, which saved_state() returns; the same "
               "on all ranks. time: a finite number. step: an integer of 64 bits. text: such as "
               "JSON; control characters other than line ends and tabs are refused. None for all "
               "three, the default, saves no state; otherwise None means 0.0, 0 or ''.");
    def_function(module, "saved_state", "path", &saved_state,
                 "The state of the program in a checkpoint: {'time': float, 'step': int, 'text': "
                 "str}, or None if Mesh.save() was called without. Reads only the header of the "
                 "file. Not collective.");
}

}  // namespace octetra::python
