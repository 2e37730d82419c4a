#include <cstddef>
#include <exception>
#include <string>

#include <pybind11/pybind11.h>

#include <octetra/core/error.hpp>
#include <octetra/core/version.hpp>

#include "bind.hpp"

namespace octetra::python {
namespace {

/// Creates an exception class of the module.
py::object error_class(py::module_& module, const char* name, const char* doc,
                       const py::object& bases) {
    const std::string full = std::string("octetra.") + name;
    auto made = py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr));
    if (!made) throw py::error_already_set();
    module.attr(name) = made;
    return made;
}

// References that live as long as the interpreter; a destructor would run after its end.
PyObject* input_error = nullptr;
PyObject* system_failure = nullptr;

void bind_errors(py::module_& module) {
    const py::object error =
        error_class(module, "Error", "The base class of the exceptions of Octetra.",
                    py::reinterpret_borrow<py::object>(PyExc_Exception));
    const auto derived = [&](const char* name, const char* doc, PyObject* builtin) {
        return error_class(module, name, doc,
                           py::make_tuple(error, py::reinterpret_borrow<py::object>(builtin)));
    };
    input_error = derived("InputError",
                          "An invalid argument, file or step. Collective functions raise it alike "
                          "on all ranks, and leave the mesh unchanged.",
                          PyExc_ValueError)
                      .release()
                      .ptr();
    system_failure = derived("SystemFailure",
                             "A failure of the system, such as a full disk. Collective functions "
                             "raise it alike on all ranks.",
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
    PyErr_Format(PyExc_TypeError, "%s cannot be constructed: functions of octetra return instances",
                 type->tp_name);
    return nullptr;
}

/// Makes objects that __new__ creates without __init__ unusable, as pybind11 would pass memory that
/// is not initialised to their methods. Classes without __init__ refuse __new__; those with
/// __init__ refuse such an object where it is used.
void refuse_objects_without_value(const py::module_& module) {
    for (const auto& [name, object] : py::dict(module.attr("__dict__"))) {
        if (!PyType_Check(object.ptr())) continue;
        auto* const type = reinterpret_cast<PyTypeObject*>(object.ptr());
        py::detail::type_info* const info = py::detail::get_type_info(type);
        if (info == nullptr) continue;  // not a class of pybind11
        // pybind11 gives a class without a constructor an __init__ that raises.
        if (Py_TYPE(object.attr("__init__").ptr()) == &PyWrapperDescr_Type) {
            object.attr("__new__") =
                py::cpp_function([type](const py::args&, const py::kwargs&) -> py::object {
                    (void)refuse_new(type, nullptr, nullptr);
                    throw py::error_already_set();
                });
            type->tp_new = refuse_new;  // for the __new__ of base classes
        } else {
            info->operator_new = [](std::size_t) -> void* {
                throw py::type_error("the object has not been initialised by __init__");
            };
        }
    }
}

}  // namespace

PYBIND11_MODULE(_octetra, module) {
    module.doc() = "The compiled part of octetra.";
    module.attr("__version__") = version();
    py::options options;
    options.disable_function_signatures();  // def_method() and def_function() write them
    bind_errors(module);
    MeshClass mesh(
        module, "Mesh",
        "A tetrahedral mesh that is distributed over the ranks of a communicator.\n\n"
        "octetra.read(), load() and from_arrays() return meshes. Numbers of vertices and cells are "
        "local to the rank and start from 0, unless stated otherwise. Arrays are read-only views; "
        "they keep their values when the mesh changes, and the mesh then has new arrays. "
        "Collective methods must be called by all ranks in the same order, and raise the same "
        "exception on all ranks.");
    bind_adaptation(module, mesh);
    bind_migration(module);
    bind_arrays(mesh);
    bind_background(module, mesh);
    bind_files(module, mesh);
    bind_fit(module, mesh);
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
    bind_certificate(module, mesh);
    bind_levels(module, mesh);
    refuse_objects_without_value(module);
}

}  // namespace octetra::python
