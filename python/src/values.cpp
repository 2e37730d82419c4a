#include "values.hpp"

#include <optional>

#include <fmt/format.h>

#include "arguments.hpp"
#include "collective.hpp"

namespace octetra::python {

py::array Values::like(std::size_t new_count, const void* data,
                       std::shared_ptr<const void> owner) const {
    std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    shape[0] = static_cast<py::ssize_t>(new_count);
    return array_over(array.dtype(), std::move(shape), data, std::move(owner), true);
}

Values values_for(const py::handle& given, std::size_t expected, const std::string& entities) {
    const py::array array = py::module_::import("numpy").attr("ascontiguousarray")(given);
    if (array.dtype().attr("hasobject").cast<bool>()) refuse("values", "numbers", given);
    const auto shape = py::str(py::handle(array).attr("shape")).cast<std::string>();
    if (static_cast<std::size_t>(array.shape(0)) != expected) {
        throw InputError(fmt::format("values of shape {} for {} {}", shape, expected, entities));
    }
    std::size_t components = 1;
    for (py::ssize_t k = 1; k < array.ndim(); ++k) {
        components *= static_cast<std::size_t>(array.shape(k));
    }
    if (components == 0) throw InputError(fmt::format("values of shape {} are no numbers", shape));
    return {array, expected, components};
}

Values values_on_each(const distributed::Communicator& processes,
                      const std::function<Values()>& convert,
                      const std::function<std::string(const Values&)>& detail) {
    std::optional<Values> values;
    std::string type;
    convert_on_each(processes, [&] {
        values = convert();
        type = py::str(values->array.dtype()).cast<std::string>();
        for (py::ssize_t k = 1; k < values->array.ndim(); ++k) {
            type += fmt::format("{}{}", k == 1 ? " of shape (n, " : ", ", values->array.shape(k));
        }
        if (values->array.ndim() > 1) type += ")";
        if (detail) type += detail(*values);
    });
    check_same(processes, type, "type of the values");
    return *std::move(values);
}

}  // namespace octetra::python
