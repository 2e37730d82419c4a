#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include <octetra/distributed/background.hpp>

namespace octetra::python {

namespace py = pybind11;

/// Background meshes from a list of octetra.Background, or None. Throws InputError.
[[nodiscard]] std::vector<distributed::Background> backgrounds_of(const py::handle& given);

}  // namespace octetra::python
