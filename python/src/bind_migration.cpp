#include <utility>

#include "bind.hpp"
#include "migration.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// Collective.
py::array moved(const Moved& move, const py::object& given, std::size_t count, const char* what,
                auto&& bring) {
    const Values values = values_on_each(move.processes, given, count, what);
    return values.like(without_gil([&] { return bring(values.copy(), values.bytes()); }));
}

py::array moved_cells(const Moved& move, const py::object& values) {
    return moved(move, values, move.cells_before, "cells before",
                 [&](std::vector<std::byte> bytes, std::size_t size) {
                     return move.migration.cells(std::move(bytes), size);
                 });
}

py::array moved_vertices(const Moved& move, const py::object& values) {
    return moved(move, values, move.vertices_before, "vertices before",
                 [&](std::vector<std::byte> bytes, std::size_t size) {
                     return move.migration.vertices(std::move(bytes), size);
                 });
}

}  // namespace

void bind_migration(py::module_& module) {
    py::class_<Moved>(module, "Migration",
                      "Where the cells of a mesh went when they moved between ranks; brings along "
                      "what a program has for each. It stays valid whatever becomes of the mesh.")
        .def_property_readonly(
            "changed", [](const Moved& move) { return move.migration.changed(); },
            "Has anything moved, on any rank? The same on all.")
        .def("cells", &moved_cells, py::arg("values"),
             "Collective. Values of this rank's cells as they were, (cells before, ...) of any "
             "numbers, to those of the cells as they are, (cells now, ...), a new array. Types and "
             "shapes but for the first number are the same on all ranks.")
        .def("vertices", &moved_vertices, py::arg("values"),
             "Collective. The same of vertices, of which all ranks that have one have the same "
             "values.");
}

}  // namespace octetra::python
