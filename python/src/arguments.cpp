#include "arguments.hpp"

#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <pybind11/eval.h>
#include <pybind11/stl/filesystem.h>

#include <octetra/core/error.hpp>

namespace octetra::python {
namespace {

/// The object in an error message: its repr(), or its type if that is long.
std::string shown(const py::handle& given) {
    constexpr std::size_t most = 80;
    const auto text = py::repr(given).cast<std::string>();
    if (text.size() <= most && text.find('\n') == std::string::npos) return text;
    return fmt::format("an object of type {}",
                       py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>());
}

}  // namespace

Signature::Signature(const char* name, const char* parameters) {
    const std::string code = fmt::format("(lambda {}: 0).__code__.co_varnames", parameters);
    const auto names = py::str(", ").attr("join")(py::eval(code)).cast<std::string>();
    py::dict scope;
    py::exec(fmt::format("def {}({}): return [{}]", name, parameters, names), scope);
    bind_ = scope[name];
}

py::list Signature::bind(const py::args& positional, const py::kwargs& named) const {
    PyObject* const bound = PyObject_Call(bind_.ptr(), positional.ptr(), named.ptr());
    if (bound != nullptr) return py::reinterpret_steal<py::list>(bound);
    const py::error_already_set error;
    if (!error.matches(PyExc_TypeError)) throw error;
    throw InputError(py::str(error.value()).cast<std::string>());
}

py::object Arguments::find(const char* name, std::size_t position) const {
    if (named_->contains(name)) return (*named_)[name];
    return position < positional_->size() ? py::object((*positional_)[position]) : py::none();
}

void refuse(const std::string& name, const std::string& expected, const py::handle& given) {
    throw InputError(fmt::format("{} must be {}, not {}", name, expected, shown(given)));
}

std::string string_from(const char* name, const py::handle& given) {
    py::detail::make_caster<std::string> caster;
    if (!py::isinstance<py::str>(given) || !caster.load(given, true)) {
        refuse(name, "a string", given);
    }
    return py::detail::cast_op<std::string&&>(std::move(caster));
}

double number_from(const char* name, const py::handle& given) {
    const double number = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    PyErr_Clear();
    refuse(name, "a number", given);
}

bool boolean_from(const char* name, const py::handle& given) {
    py::detail::make_caster<bool> caster;
    if (given.is_none() || !caster.load(given, true)) refuse(name, "True or False", given);
    return py::detail::cast_op<bool>(caster);
}

std::filesystem::path path_from(const char* name, const py::handle& given) {
    py::detail::make_caster<std::filesystem::path> caster;
    if (!caster.load(given, true)) refuse(name, "a string or an os.PathLike", given);
    return py::detail::cast_op<std::filesystem::path&&>(std::move(caster));
}

Closure closure_from(const char* name, const py::handle& given) {
    const std::string closure = string_from(name, given);
    if (closure == "regular") return Closure::regular;
    if (closure == "longest-edge") return Closure::longest_edge;
    throw InputError(
        fmt::format("{} must be 'longest-edge' or 'regular', not '{}'", name, closure));
}

template <class T>
T integer_from(const char* name, const py::handle& given, const char* or_else) {
    using Limits = std::numeric_limits<T>;
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
    if (number) {
        const auto value = [&] {
            if constexpr (std::is_signed_v<T>) {
                return PyLong_AsLongLong(number.ptr());
            } else {
                return PyLong_AsUnsignedLongLong(number.ptr());
            }
        }();
        const bool fits =
            PyErr_Occurred() == nullptr && value >= Limits::min() && value <= Limits::max();
        if (fits) return static_cast<T>(value);
    }
    PyErr_Clear();
    refuse(name, fmt::format("an integer from {} to {}{}", Limits::min(), Limits::max(), or_else),
           given);
}

template std::int32_t integer_from(const char*, const py::handle&, const char*);
template std::uint32_t integer_from(const char*, const py::handle&, const char*);
template std::int64_t integer_from(const char*, const py::handle&, const char*);
template std::uint64_t integer_from(const char*, const py::handle&, const char*);

}  // namespace octetra::python
