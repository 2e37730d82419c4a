#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <octetra/distributed/conservative_transfer.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

using Adaptation = std::shared_ptr<od::Adaptation>;
using EntityTransfer = std::shared_ptr<od::EntityTransfer>;

od::CellValues cell_values(const std::string& how) {
    if (how == "copied") return od::CellValues::copied;
    if (how == "averaged") return od::CellValues::averaged;
    if (how == "divided") return od::CellValues::divided;
    throw InputError(fmt::format("how must be 'copied', 'averaged' or 'divided', not '{}'", how));
}

py::array transfer_vertices(const od::Adaptation& step, const Arguments& arguments) {
    const Values values =
        values_for(arguments.values<1>()[0], step.vertex_count_before, "vertices before the step");
    return with_field_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step.transfer_vertices(std::move(own), values.components);
        }));
    });
}

py::array transfer_cells(const od::Adaptation& step, const Arguments& arguments) {
    const auto [given, method] = arguments.values<2>();
    const Values values = values_for(given, step.cells.count_before(), "cells before the step");
    const od::CellValues how = cell_values(string_from("how", method));
    return with_field_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step.transfer_cells(std::move(own), values.components, how);
        }));
    });
}

py::array parents(const EntityTransfer& of) {
    if (of->merges()) {
        throw InputError("parents describe refinement; coarse_of describes coarsening");
    }
    return array_of(without_gil([&] { return of->parents(); }));
}

void bind_entity_transfer(py::module_& module) {
    py::class_<od::EntityTransfer, EntityTransfer>(
        module, "EntityTransfer",
        "The relation between this rank's cells, tagged facets or tagged edges before a step and "
        "those after it.")
        .def_property_readonly("count_before", &od::EntityTransfer::count_before,
                               "int: their number before the step.")
        .def_property_readonly("count", &od::EntityTransfer::count,
                               "int: their number after the step.")
        .def_property_readonly("keeps_numbers", &od::EntityTransfer::keeps_numbers,
                               "bool: whether all entities that were not bisected have the same "
                               "number as before.")
        .def_property_readonly("parents", &parents,
                               "int32 (count,), of refinement: the entity before the step that "
                               "each entity is, or is a part of. Computed on access.")
        .def_property_readonly(
            "coarse_of", [](const EntityTransfer& of) { return view(of->coarse_of(), of); },
            "int32 (count_before,), of coarsening: the entity after the step that each entity has "
            "become, or has become a part of. Of refinement: (0,).")
        .def_property_readonly(
            "halvings", [](const EntityTransfer& of) { return view(of->halvings(), of); },
            "uint8 (count_before,), of cells in coarsening: how many bisections had made each cell "
            "from the cell after the step. Otherwise: (0,).");
}

/// Collective. All ranks must pass values of one type and shape.
py::array transfer_conservatively(Mesh& mesh, const Arguments& arguments) {
    const od::Adaptation* step = nullptr;
    std::optional<Values> values;
    std::string type;
    convert_on_each(mesh.processes(), [&] {
        const auto [adaptation, given] = arguments.values<2>();
        step = &instance_from<od::Adaptation>("step", adaptation, "an octetra.Adaptation");
        values = values_for(given, step->vertex_count_before, "vertices before the step");
        const char kind = values->array.dtype().kind();
        if (kind != 'f' && kind != 'c') throw InputError("values must be real or complex numbers");
        with_field_type(values->array, [](auto) {});
        type = fmt::format("{}, {} values for each vertex",
                           py::str(values->array.dtype()).cast<std::string>(), values->components);
    });
    check_same(mesh.processes(), type, "type of the values");
    return with_field_type(values->array, [&]<class T>(T) -> py::array {
        if constexpr (std::is_integral_v<T>) {
            return {};
        } else {
            return values->like(mesh.ask([&, own = values->copy<T>()](
                                             const od::AdaptiveMesh& now) mutable {
                return od::transfer_conservatively(now, *step, std::move(own), values->components);
            }));
        }
    });
}

}  // namespace

void bind_adaptation(py::module_& module, MeshClass& mesh) {
    bind_entity_transfer(module);
    def_method(mesh, "transfer_conservatively", "step, values", &transfer_conservatively,
               "Collective. Transfers the values of a continuous, piecewise linear function to the "
               "vertices after a step, with the same integral over the whole mesh.\n\n"
               "step: the Adaptation of the last step of the mesh. values: (vertices before, ...) "
               "of float64, float32, complex128 or complex64. Returns a new array, (vertices now, "
               "...). In coarsening, the difference between the function and its interpolant at a "
               "removed vertex is added to the ends of the edge that the vertex halved; a function "
               "that is linear there is transferred exactly.");
    const auto entity_transfer = [](od::EntityTransfer od::Adaptation::*of) {
        return [of](const Adaptation& step) { return EntityTransfer(step, &((*step).*of)); };
    };
    const auto list = [](auto of) {
        return [of](const Adaptation& step) {
            return view(std::span(std::as_const((*step).*of)), step);
        };
    };
    py::class_<od::Adaptation, Adaptation> adaptation(
        module, "Adaptation",
        "The effect of a step on this rank's part: the relation between entities before and after "
        "the step. It remains valid when the mesh changes. No method is collective.");
    adaptation
        .def_readonly("changed", &od::Adaptation::changed,
                      "bool: whether the step has changed anything, on any rank. The same on all "
                      "ranks.")
        .def_property_readonly("is_coarser", &od::Adaptation::is_coarser,
                               "bool: whether the step was coarsening.")
        .def_property_readonly("cells", entity_transfer(&od::Adaptation::cells),
                               "EntityTransfer of this rank's cells.")
        .def_property_readonly("facets", entity_transfer(&od::Adaptation::facets),
                               "EntityTransfer of this rank's tagged facets.")
        .def_property_readonly("edges", entity_transfer(&od::Adaptation::edges),
                               "EntityTransfer of this rank's tagged edges.")
        .def_readonly("vertex_count_before", &od::Adaptation::vertex_count_before,
                      "int: the number of this rank's vertices before the step.")
        .def_property_readonly(
            "new_vertex_ends", list(&od::Adaptation::new_vertex_ends),
            "int32 (new vertices, 2), of refinement: the ends of the edge that "
            "each new vertex halves, by the numbers after the step. The first new "
            "vertex has the number vertex_count_before, unless the closure is "
            "'regular': then vertices_before is -1 for new vertices.")
        .def_property_readonly(
            "vertices_before", list(&od::Adaptation::vertices_before),
            "int32 (vertices,), of coarsening and of refinement with the closure "
            "'regular': the number that each vertex had before the step, -1 for "
            "new vertices. Otherwise empty.");
    def_method(adaptation, "transfer_vertices", "values", &transfer_vertices,
               "Transfers the values of a continuous, piecewise linear function to the vertices "
               "after the step.\n\n"
               "values: (vertices before, ...) of float64, float32, complex128 or complex64, and "
               "in coarsening also of int32 or int64. Returns a new array, (vertices now, ...). A "
               "new vertex gets the mean of the ends of its edge. Coarsening keeps the values of "
               "the remaining vertices, and thereby changes the integral; "
               "Mesh.transfer_conservatively() preserves it.");
    def_method(adaptation, "transfer_cells", "values, how='copied'", &transfer_cells,
               "Transfers values of cells to the cells after the step.\n\n"
               "values: (cells before, ...) of float64, float32, complex128, complex64, int32 or "
               "int64. Returns a new array, (cells now, ...). how: 'copied', the value of the "
               "parent for each child, and in coarsening the mean of the merged cells weighted by "
               "volume, which preserves the integral, or of integers the most frequent value; "
               "'averaged', the same for real and complex numbers, with integers refused; "
               "'divided', the value of the parent divided in proportion to volume, and in "
               "coarsening the sum. Integers can be copied, and in coarsening summed.");
}

}  // namespace octetra::python
