#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "held_mesh.hpp"

/// Definitions of the functions and classes of octetra._octetra.
namespace octetra::python {

using MeshClass = py::class_<Mesh, MeshPointer>;

void bind_arrays(MeshClass& mesh);
void bind_background(py::module_& module, MeshClass& mesh);
void bind_certificate(py::module_& module, MeshClass& mesh);
void bind_fit(py::module_& module, MeshClass& mesh);
void bind_files(py::module_& module, MeshClass& mesh);
void bind_from_arrays(py::module_& module);
void bind_steps(py::module_& module, MeshClass& mesh);
void bind_adaptation(py::module_& module, MeshClass& mesh);
void bind_migration(py::module_& module);
void bind_levels(py::module_& module, MeshClass& mesh);
void bind_marks(py::module_& module);
void bind_sharing(py::module_& module, MeshClass& mesh);
void bind_sides(py::module_& module, MeshClass& mesh);
void bind_ghosts(py::module_& module, MeshClass& mesh);
void bind_quality(py::module_& module);
void bind_vertex_sets(MeshClass& mesh);
void bind_series(py::module_& module, MeshClass& mesh);
void bind_verify(py::module_& module, MeshClass& mesh);

}  // namespace octetra::python
