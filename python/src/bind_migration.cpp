#include <utility>
#include <vector>

#include "arguments.hpp"
#include "bind.hpp"
#include "migration.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

/// Collective. The result of transfer(bytes, bytes of an entity).
py::array moved(const Moved& move, const Arguments& arguments, std::size_t count,
                const char* entities, auto&& transfer) {
    const Values values = values_on_each(
        move.processes, [&] { return values_for(arguments.values<1>()[0], count, entities); });
    return values.like(without_gil([&, copy = values.copy(), size = values.bytes()]() mutable {
        return transfer(std::move(copy), size);
    }));
}

py::array moved_cells(const Moved& move, const Arguments& arguments) {
    return moved(move, arguments, move.cells_before, "cells before",
                 [&](std::vector<std::byte> bytes, std::size_t size) {
                     return move.migration.cells(std::move(bytes), size);
                 });
}

py::array moved_vertices(const Moved& move, const Arguments& arguments) {
    return moved(move, arguments, move.vertices_before, "vertices before",
                 [&](std::vector<std::byte> bytes, std::size_t size) {
                     return move.migration.vertices(std::move(bytes), size);
                 });
}

}  // namespace

void bind_migration(py::module_& module) {
    py::class_<Moved> migration(
        module, "Migration",
        "The movement of cells between ranks by one call. It transfers values of cells and "
        "vertices to the ranks that have them now, and remains valid when the mesh changes.");
    migration.def_property_readonly(
        "changed", [](const Moved& move) { return move.migration.changed(); },
        "bool: whether any cell has moved, on any rank. The same on all ranks.");
    def_method(migration, "cells", "values", &moved_cells,
               "Collective. Transfers values of this rank's cells before, (cells before, ...) of "
               "any numbers, to the cells now: a new array, (cells now, ...). Types, and shapes "
               "but for the first dimension, must be the same on all ranks.");
    def_method(migration, "vertices", "values", &moved_vertices,
               "Collective. The same for values of vertices, which must be equal on all ranks "
               "that have the vertex.");
}

}  // namespace octetra::python
