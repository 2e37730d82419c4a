#pragma once

#include <pybind11/pybind11.h>

#include <octetra/distributed/adaptive_mesh.hpp>

namespace octetra::python {

/// The options of a step that refines. Throws InputError for invalid arguments.
[[nodiscard]] distributed::StepOptions step_options(const pybind11::object& scheme,
                                                    const pybind11::object& closure,
                                                    const pybind11::object& max_cells);

}  // namespace octetra::python
