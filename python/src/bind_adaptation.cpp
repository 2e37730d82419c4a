#include <memory>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "values.hpp"

namespace octetra::python {
namespace {

using Adaptation = std::shared_ptr<od::Adaptation>;
using Succession = std::shared_ptr<od::Succession>;

od::CellValues cell_values(const std::string& how) {
    if (how == "copied") return od::CellValues::copied;
    if (how == "averaged") return od::CellValues::averaged;
    if (how == "divided") return od::CellValues::divided;
    throw InputError("how: 'copied', 'averaged' or 'divided'");
}

py::array transfer_vertices(const Adaptation& step, const py::object& given) {
    const Values values = values_for(given, step->vertex_count_before, "vertices before the step");
    return with_number_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step->transfer_vertices(std::move(own), values.components);
        }));
    });
}

py::array transfer_cells(const Adaptation& step, const py::object& given, const std::string& how) {
    const Values values = values_for(given, step->cells.count_before(), "cells before the step");
    return with_number_type(values.array, [&]<class T>(T) {
        return values.like(without_gil([&, own = values.copy<T>()]() mutable {
            return step->transfer_cells(std::move(own), values.components, cell_values(how));
        }));
    });
}

py::array parents(const Succession& of) {
    if (of->merges()) throw InputError("parents are of refinement; of coarsening it is whole_of");
    return array_of(without_gil([&] { return of->parents(); }));
}

void bind_succession(py::module_& module) {
    py::class_<od::Succession, Succession>(
        module, "Succession",
        "How this rank's cells, tagged facets or tagged edges became those after a step.")
        .def_property_readonly("count_before", &od::Succession::count_before,
                               "How many there were.")
        .def_property_readonly("count", &od::Succession::count, "How many there are.")
        .def_property_readonly("keeps_numbers", &od::Succession::keeps_numbers,
                               "Has all that was not bisected its number still?")
        .def_property_readonly("parents", &parents,
                               "uint32 (count,), of refinement: what each is, or is a piece of. "
                               "Made when asked for.")
        .def_property_readonly(
            "whole_of", [](const Succession& of) { return view(of->whole_of(), of); },
            "uint32 (count_before,), of coarsening: what each became, or is a piece of; (0,) of "
            "refinement.")
        .def_property_readonly(
            "halvings", [](const Succession& of) { return view(of->halvings(), of); },
            "uint8 (count_before,), of cells in coarsening: how often the whole had been halved "
            "for "
            "each; else (0,).");
}

}  // namespace

void bind_adaptation(py::module_& module) {
    bind_succession(module);
    const auto succession = [](od::Succession od::Adaptation::*of) {
        return [of](const Adaptation& step) { return Succession(step, &((*step).*of)); };
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
        .def_property_readonly("cells", succession(&od::Adaptation::cells), "This rank's cells.")
        .def_property_readonly("facets", succession(&od::Adaptation::facets),
                               "This rank's tagged facets.")
        .def_property_readonly("edges", succession(&od::Adaptation::edges),
                               "This rank's tagged edges.")
        .def_readonly("vertex_count_before", &od::Adaptation::vertex_count_before,
                      "This rank's vertices before the step.")
        .def_property_readonly("new_vertex_ends", list(&od::Adaptation::new_vertex_ends),
                               "uint32 (new vertices, 2): the ends of the edge that each halves; "
                               "vertex_count_before is the number of the first.")
        .def_property_readonly("vertices_before", list(&od::Adaptation::vertices_before),
                               "uint32 (vertices,), of coarsening: the number that each had.")
        .def(
            "transfer_vertices", &transfer_vertices, py::arg("values"),
            "Values of a continuous, piecewise linear function: (vertices before, ...) of float64 "
            "or float32 to (vertices now, ...), a new array. New vertices get the mean of the ends "
            "of their edge, which whole numbers do not have: int32 and int64 only of coarsening.")
        .def(
            "transfer_cells", &transfer_cells, py::arg("values"), py::arg("how") = "copied",
            "Values of cells: (cells before, ...) of float64, float32, int32 or int64 to "
            "(cells now, ...), a new array. how: 'copied', each child the same (of coarsening, the "
            "pieces' mean, and of whole numbers what most of them have); 'averaged', each the same "
            "(the mean weighted by volumes); 'divided', by the children's shares in the volume "
            "(the sum). Whole numbers can be copied, and of coarsening added up.");
}

}  // namespace octetra::python
