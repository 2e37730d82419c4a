#include <cstddef>
#include <exception>
#include <string>

#include <pybind11/pybind11.h>

#include <octetra/core/error.hpp>
#include <octetra/core/version.hpp>

#include "bind.hpp"

namespace octetra::python {
namespace {

/// A new exception class of the module.
py::object error_class(py::module_& module, const char* name, const char* doc,
                       const py::object& bases) {
    const std::string full = std::string("octetra.") + name;
    auto made = py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr));
    if (!made) throw py::error_already_set();
    module.attr(name) = made;
    return made;
}

// Kept as long as the interpreter lives, which a destructor would not know.
PyObject* input_error = nullptr;
PyObject* system_failure = nullptr;

void bind_errors(py::module_& module) {
    const py::object error = error_class(module, "Error", "What Octetra raises.",
                                         py::reinterpret_borrow<py::object>(PyExc_Exception));
    const auto derived = [&](const char* name, const char* doc, PyObject* builtin) {
        return error_class(module, name, doc,
                           py::make_tuple(error, py::reinterpret_borrow<py::object>(builtin)));
    };
    input_error = derived("InputError",
                          "An argument, a file or a step that is not right. Raised alike on all "
                          "ranks by what is collective; the mesh is then as it was before.",
                          PyExc_ValueError)
                      .release()
                      .ptr();
    system_failure = derived("SystemFailure",
                             "The system failed: a disk is full, a file cannot be written. Raised "
                             "alike on all ranks by what is collective.",
                             PyExc_RuntimeError)
                         .release()
                         .ptr();
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const InputError& found) {
            PyErr_SetString(input_error, found.what());
        } catch (const SystemError& found) {
            PyErr_SetString(system_failure, found.what());
        }
    });
}

PyObject* refuse_new(PyTypeObject* type, PyObject*, PyObject*) {
    PyErr_Format(PyExc_TypeError, "%s: objects are returned by functions of octetra, and not made",
                 type->tp_name);
    return nullptr;
}

/// __new__ without __init__ makes an object that has no value; pybind11 would give its methods
/// memory to which nothing was written. Classes without __init__ refuse __new__, and those with one
/// refuse such an object where it is used.
void refuse_objects_without_value(const py::module_& module) {
    for (const auto& [name, object] : py::dict(module.attr("__dict__"))) {
        if (!PyType_Check(object.ptr())) continue;
        auto* const type = reinterpret_cast<PyTypeObject*>(object.ptr());
        py::detail::type_info* const info = py::detail::get_type_info(type);
        if (info == nullptr) continue;  // no class of pybind11
        // pybind11 gives a class without a constructor an __init__ that raises.
        if (Py_TYPE(object.attr("__init__").ptr()) == &PyWrapperDescr_Type) {
            type->tp_new = refuse_new;
        } else {
            info->operator_new = [](std::size_t) -> void* {
                throw py::type_error("an object that was made without __init__");
            };
        }
    }
}

}  // namespace

PYBIND11_MODULE(_octetra, module) {
    module.doc() = "The compiled part of octetra.";
    module.attr("__version__") = version();
    py::options options;
    options.disable_enum_members_docstring();
    bind_errors(module);
    MeshClass mesh(
        module, "Mesh",
        "A tetrahedral mesh of which each rank of a communicator has a part.\n\n"
        "Numbers of vertices and cells are local to the rank, from 0, where nothing else "
        "is said. Arrays are read-only and no copies; they stay as they are when the "
        "mesh moves on, which then has new ones. Collective methods are called by all "
        "ranks in the same order, and raise alike on all of them.");
    bind_adaptation(module, mesh);
    bind_migration(module);
    bind_arrays(mesh);
    bind_files(module, mesh);
    bind_from_arrays(module);
    bind_steps(module, mesh);
    bind_marks(module);
    bind_sharing(module, mesh);
    bind_sides(module, mesh);
    bind_ghosts(module, mesh);
    bind_quality(module);
    bind_vertex_sets(mesh);
    bind_series(module, mesh);
    bind_verify(module, mesh);
    refuse_objects_without_value(module);
}

}  // namespace octetra::python
