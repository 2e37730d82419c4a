#pragma once

#include <cstddef>
#include <vector>

#include <pybind11/pybind11.h>

#include <octetra/distributed/field.hpp>

namespace octetra::python {

namespace py = pybind11;

/// Fields of the mesh from {name: values}, or None, for vertices and for cells. Throws InputError.
[[nodiscard]] std::vector<distributed::Field> fields_of(const py::object& on_vertices,
                                                        const py::object& on_cells,
                                                        std::size_t vertex_count,
                                                        std::size_t cell_count);

/// The fields of one kind as {name: values}, of shape (n,) or (n, components).
[[nodiscard]] py::dict dict_of(std::vector<distributed::Field> fields, FieldOn on);

}  // namespace octetra::python
