#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <octetra/distributed/conservative_transfer.hpp>

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
    throw InputError("how: 'copied', 'averaged' or 'divided'");
}

py::array transfer_vertices(const Adaptation& step, const py::object& given) {
    const Values values = values_for(given, step->vertex_count_before, "vertices before the step");
    return with_field_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step->transfer_vertices(std::move(own), values.components);
        }));
    });
}

py::array transfer_cells(const Adaptation& step, const py::object& given, const std::string& how) {
    const Values values = values_for(given, step->cells.count_before(), "cells before the step");
    return with_field_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step->transfer_cells(std::move(own), values.components, cell_values(how));
        }));
    });
}

py::array parents(const EntityTransfer& of) {
    if (of->merges()) throw InputError("parents are of refinement; of coarsening it is coarse_of");
    return array_of(without_gil([&] { return of->parents(); }));
}

void bind_succession(py::module_& module) {
    py::class_<od::EntityTransfer, EntityTransfer>(
        module, "EntityTransfer",
        "How this rank's cells, tagged facets or tagged edges became those after a step.")
        .def_property_readonly("count_before", &od::EntityTransfer::count_before,
                               "How many there were.")
        .def_property_readonly("count", &od::EntityTransfer::count, "How many there are.")
        .def_property_readonly("keeps_numbers", &od::EntityTransfer::keeps_numbers,
                               "Has all that was not bisected its number still?")
        .def_property_readonly("parents", &parents,
                               "int32 (count,), of refinement: what each is, or is a piece of. "
                               "Made when asked for.")
        .def_property_readonly(
            "coarse_of", [](const EntityTransfer& of) { return view(of->coarse_of(), of); },
            "int32 (count_before,), of coarsening: what each became, or is a piece of; (0,) of "
            "refinement.")
        .def_property_readonly(
            "halvings", [](const EntityTransfer& of) { return view(of->halvings(), of); },
            "uint8 (count_before,), of cells in coarsening: how often the whole had been halved "
            "for "
            "each; else (0,).");
}

/// Collective. All ranks pass values of one type and shape.
py::array transfer_conservatively(Mesh& mesh, const Adaptation& step, const py::object& given) {
    std::optional<Values> values;
    std::string type;
    convert_on_each(mesh.processes(), [&] {
        values = values_for(given, step->vertex_count_before, "vertices before the step");
        const char kind = values->array.dtype().kind();
        if (kind != 'f' && kind != 'c') throw InputError("values have a real or complex type");
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
    bind_succession(module);
    mesh.def("transfer_conservatively", &transfer_conservatively, py::arg("step").none(false),
             py::arg("values"),
             "Collective. Values of a continuous, piecewise linear function, (vertices before, "
             "...) of float64, float32, complex128 or complex64, to (vertices now, ...), a new "
             "array, with the same integral over the whole mesh. step: the mesh's last one. Of "
             "coarsening, what the function deviates from its interpolant at a vertex that went "
             "is given to the ends of the edge that the vertex halved; a function that is linear "
             "there stays as it is.");
    const auto entity_transfer = [](od::EntityTransfer od::Adaptation::*of) {
        return [of](const Adaptation& step) { return EntityTransfer(step, &((*step).*of)); };
    };
    const auto list = [](auto of) {
        return [of](const Adaptation& step) {
            return view(std::span(std::as_const((*step).*of)), step);
        };
    };
    py::class_<od::Adaptation, Adaptation>(
        module, "Adaptation",
        "What a step did to this rank's part: for everything that there is now, what it was "
        "before. "
        "It stays valid whatever becomes of the mesh. Nothing here is collective.")
        .def_readonly("changed", &od::Adaptation::changed,
                      "Did anything change, on any rank? The same on all.")
        .def_property_readonly("is_coarser", &od::Adaptation::is_coarser, "Was this coarsening?")
        .def_property_readonly("cells", entity_transfer(&od::Adaptation::cells),
                               "This rank's cells.")
        .def_property_readonly("facets", entity_transfer(&od::Adaptation::facets),
                               "This rank's tagged facets.")
        .def_property_readonly("edges", entity_transfer(&od::Adaptation::edges),
                               "This rank's tagged edges.")
        .def_readonly("vertex_count_before", &od::Adaptation::vertex_count_before,
                      "This rank's vertices before the step.")
        .def_property_readonly("new_vertex_ends", list(&od::Adaptation::new_vertex_ends),
                               "int32 (new vertices, 2): the ends of the edge that each halves; "
                               "vertex_count_before is the number of the first.")
        .def_property_readonly("vertices_before", list(&od::Adaptation::vertices_before),
                               "int32 (vertices,), of coarsening: the number that each had.")
        .def(
            "transfer_vertices", &transfer_vertices, py::arg("values"),
            "Values of a continuous, piecewise linear function: (vertices before, ...) of float64, "
            "float32, complex128 or complex64 to (vertices now, ...), a new array. New vertices "
            "get the mean of the ends of their edge, which whole numbers do not have: int32 and "
            "int64 only of coarsening. Coarsening keeps the values of the vertices that stay, and "
            "so changes the integral; Mesh.transfer_conservatively() keeps it.")
        .def("transfer_cells", &transfer_cells, py::arg("values"), py::arg("how") = "copied",
             "Values of cells: (cells before, ...) of float64, float32, complex128, complex64, "
             "int32 or int64 to (cells now, ...), a new array. how: 'copied', each child the same "
             "(of coarsening, the pieces' mean weighted by volumes, which keeps the integral, and "
             "of whole numbers what most of them have); 'averaged', as 'copied', but whole numbers "
             "are refused; 'divided', by the children's shares in the volume "
             "(the sum). Whole numbers can be copied, and of coarsening added up.");
}

}  // namespace octetra::python
