#pragma once

#include <cstddef>
#include <vector>

#include <pybind11/pybind11.h>

#include <octetra/distributed/field.hpp>

namespace octetra::python {

namespace py = pybind11;

/// Fields from what Python has, {name: values} or None: for so many vertices and cells.
[[nodiscard]] std::vector<distributed::Field> fields_of(const py::object& on_vertices,
                                                        const py::object& on_cells,
                                                        std::size_t vertex_count,
                                                        std::size_t cell_count);

/// The other way: {name: values}, of shape (n,) or (n, components).
[[nodiscard]] py::dict dict_of(std::vector<distributed::Field> fields, FieldOn on);

}  // namespace octetra::python
