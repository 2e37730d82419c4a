#include "fields.hpp"

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "arguments.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

void append(std::vector<distributed::Field>& fields, const py::object& given, FieldOn on,
            std::size_t count) {
    if (given.is_none()) return;
    const char* const argument = on == FieldOn::cells ? "cell_fields" : "vertex_fields";
    if (!py::hasattr(given, "keys")) refuse(argument, "a dict {name: array}", given);
    for (const auto& item : py::dict(given)) {
        const std::string name = string_from("the name of a field", item.first);
        try {
            const Values values =
                values_for(item.second, count, on == FieldOn::cells ? "cells" : "vertices");
            with_number_type(values.array, [&]<class T>(T) {
                fields.push_back({name, on, values.components, values.copy<T>()});
            });
        } catch (const InputError& error) {
            throw InputError(fmt::format("field '{}': {}", name, error.what()));
        }
    }
}

}  // namespace

std::vector<distributed::Field> fields_of(const py::object& on_vertices, const py::object& on_cells,
                                          std::size_t vertex_count, std::size_t cell_count) {
    std::vector<distributed::Field> fields;
    append(fields, on_vertices, FieldOn::vertices, vertex_count);
    append(fields, on_cells, FieldOn::cells, cell_count);
    return fields;
}

py::dict dict_of(std::vector<distributed::Field> fields, FieldOn on) {
    py::dict values;
    for (distributed::Field& field : fields) {
        if (field.on != on) continue;
        std::visit(
            [&]<class T>(std::vector<T>& list) {
                const auto kept = std::make_shared<const std::vector<T>>(std::move(list));
                const auto components = static_cast<py::ssize_t>(field.components);
                std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(kept->size()) / components};
                if (components > 1) shape.push_back(components);
                values[py::str(field.name)] =
                    array_over(py::dtype::of<T>(), std::move(shape), kept->data(), kept, true);
            },
            field.values);
    }
    return values;
}

}  // namespace octetra::python
