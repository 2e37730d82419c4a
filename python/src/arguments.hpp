#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include <octetra/core/closure.hpp>

/// Arguments that Python passes: bound to the parameters of a function, and converted. A collective
/// function does both in the section in which ranks agree on failures, because an argument that
/// one rank alone refuses beforehand would leave the other ranks waiting.
namespace octetra::python {

namespace py = pybind11;

/// The parameters of a function, in the notation of Python: "marks=None, *, scheme='8t'".
class Signature {
public:
    Signature(const char* name, const char* parameters);

    /// The arguments of a call in the order of the parameters, defaults included. Throws InputError
    /// with the message of Python if an argument is missing, unknown or given twice.
    [[nodiscard]] py::list bind(const py::args& positional, const py::kwargs& named) const;

private:
    py::object bind_;  // a function of Python, which returns its arguments
};

/// The arguments of one call.
class Arguments {
public:
    Arguments(const Signature& signature, const py::args& positional, const py::kwargs& named)
        : signature_(&signature), positional_(&positional), named_(&named) {}

    /// The arguments for the `count` parameters of the function. Throws as Signature::bind().
    template <std::size_t count>
    [[nodiscard]] std::array<py::object, count> values() const {
        const py::list bound = signature_->bind(*positional_, *named_);
        std::array<py::object, count> values;
        for (std::size_t i = 0; i < count; ++i) values[i] = bound[i];
        return values;
    }
    /// Throws as Signature::bind().
    void check() const { (void)signature_->bind(*positional_, *named_); }

    /// One argument, or None, even if others do not match the signature: the object that knows the
    /// communicator is needed for the agreement on everything else.
    [[nodiscard]] py::object find(const char* name, std::size_t position) const;

private:
    const Signature* signature_;
    const py::args* positional_;
    const py::kwargs* named_;
};

/// Throws InputError: argument `name` must be `expected`, and is `given`.
[[noreturn]] void refuse(const std::string& name, const std::string& expected,
                         const py::handle& given);

// Conversions of the argument `name`. They throw InputError, and never convert None.
[[nodiscard]] std::string string_from(const char* name, const py::handle& given);
[[nodiscard]] double number_from(const char* name, const py::handle& given);
[[nodiscard]] bool boolean_from(const char* name, const py::handle& given);
[[nodiscard]] std::filesystem::path path_from(const char* name, const py::handle& given);
[[nodiscard]] Closure closure_from(const char* name, const py::handle& given);

/// An integer that fits into T: std::int32_t, std::uint32_t, std::int64_t or std::uint64_t.
/// `or_else` continues the message where other types are accepted as well.
template <class T>
[[nodiscard]] T integer_from(const char* name, const py::handle& given, const char* or_else = "");

/// An object of a class of the module, which Python calls `type`.
template <class T>
[[nodiscard]] T& instance_from(const char* name, const py::handle& given, const char* type) {
    if (!py::isinstance<T>(given)) refuse(name, type, given);
    return given.cast<T&>();
}

/// Defines a method that calls function(self, arguments).
template <class T, class... Options>
void def_method(py::class_<T, Options...>& type, const char* name, const char* parameters,
                auto function, const char* doc) {
    const std::string rest = *parameters == '\0' ? "" : std::string(", ") + parameters;
    const std::string text = std::string(name) + "(self" + rest + ")\n--\n\n" + doc;
    type.def(
        name,
        [function, signature = Signature(name, parameters)](T& self, const py::args& positional,
                                                            const py::kwargs& named) {
            return function(self, Arguments(signature, positional, named));
        },
        text.c_str());
}

/// Defines a function of a module that calls function(arguments).
void def_function(py::module_& module, const char* name, const char* parameters, auto function,
                  const char* doc) {
    const std::string text = std::string(name) + "(" + parameters + ")\n--\n\n" + doc;
    module.def(
        name,
        [function, signature = Signature(name, parameters)](const py::args& positional,
                                                            const py::kwargs& named) {
            return function(Arguments(signature, positional, named));
        },
        text.c_str());
}

}  // namespace octetra::python
