#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <octetra/core/expression.hpp>
#include <octetra/distributed/fit.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "backgrounds.hpp"
#include "bind.hpp"
#include "fields.hpp"
#include "step_options.hpp"

namespace octetra::python {
namespace {

/// The class Fit of Python.
struct MeshFit {
    MeshPointer mesh;
    od::FitOptions options;
    std::optional<od::Fit> fit;  ///< as soon as it is used

    od::Fit& of(od::AdaptiveMesh& now) {
        if (!fit) fit.emplace(now, options);
        return *fit;
    }
};

/// Collective.
std::unique_ptr<MeshFit> make_fit(const Arguments& arguments) {
    Mesh& mesh = instance_from<Mesh>("mesh", arguments.find("mesh", 0), "an octetra.Mesh");
    auto fit = std::make_unique<MeshFit>();
    fit->mesh = mesh.shared_from_this();
    convert_on_each(mesh.processes(), [&] {
        const auto [itself, scheme, closure, levels, max_cells] = arguments.values<5>();
        fit->options.step = step_options(scheme, closure, max_cells);
        fit->options.levels = integer_from<std::int32_t>("levels", levels);
    });
    return fit;
}

/// Collective.
std::shared_ptr<od::Adaptation> next_step(MeshFit& fit, const Arguments& arguments) {
    std::vector<double> sizes;
    return fit.mesh->change([&] { sizes = values_of<double>("sizes", arguments.values<1>()[0]); },
                            [&](od::AdaptiveMesh& now) -> std::shared_ptr<od::Adaptation> {
                                auto done = fit.of(now).next(sizes);
                                if (!done) return nullptr;
                                return std::make_shared<od::Adaptation>(std::move(done->step));
                            });
}

/// Collective.
py::dict counts_of_misfits(MeshFit& fit, const Arguments& arguments) {
    std::vector<double> sizes;
    const od::MisfitCells found =
        fit.mesh->change([&] { sizes = values_of<double>("sizes", arguments.values<1>()[0]); },
                         [&](od::AdaptiveMesh& now) { return fit.of(now).misfit_cells(sizes); });
    py::dict counts;
    counts["too_long"] = found.too_long;
    counts["too_short"] = found.too_short;
    counts["too_short_roots"] = found.too_short_roots;
    return counts;
}

/// Collective.
py::array values_of_expression(Mesh& mesh, const Arguments& arguments) {
    std::optional<Expression> expression;
    std::vector<od::Field> fields;
    std::vector<od::Background> backgrounds;
    convert_on_each(mesh.processes(), [&] {
        const auto [text, on_vertices, on_cells, given] = arguments.values<4>();
        expression.emplace(string_from("expression", text));
        fields = fields_of(py::reinterpret_borrow<py::object>(on_vertices),
                           py::reinterpret_borrow<py::object>(on_cells), mesh.vertex_count(),
                           mesh.cell_count());
        backgrounds = backgrounds_of(given);
    });
    return array_of(mesh.ask([&](const od::AdaptiveMesh& now) {
        return now.cell_values(*expression, fields, backgrounds);
    }));
}

/// Collective.
std::uint64_t predicted_count(Mesh& mesh, const Arguments& arguments) {
    Marks which;
    od::StepOptions options;
    return mesh.change(
        [&] {
            const auto [marks, scheme, closure] = arguments.values<3>();
            which = marks_of(marks, mesh.cell_count());
            options = step_options(scheme, closure, py::none());
        },
        [&](od::AdaptiveMesh& now) { return now.cells_after(which.bytes, options); });
}

/// Collective.
py::array reduced_marks(Mesh& mesh, const Arguments& arguments) {
    Marks which;
    std::uint64_t count = 0;
    od::StepOptions options;
    return booleans(mesh.change(
        [&] {
            const auto [marks, most, scheme, closure] = arguments.values<4>();
            which = marks_of(marks, mesh.cell_count());
            count = integer_from<std::uint64_t>("count", most);
            options = step_options(scheme, closure, py::none());
        },
        [&](od::AdaptiveMesh& now) { return now.marks_within(which.bytes, count, options); }));
}

}  // namespace

void bind_fit(py::module_& module, MeshClass& mesh) {
    def_method(mesh, "cell_values",
               "expression, vertex_fields=None, cell_fields=None, backgrounds=None",
               &values_of_expression,
               "Collective. float64 (cells,): the value of an expression in each cell of this "
               "rank, such as \"0.02 + distance(wall) / 4\". Arguments as for mark.where().");
    def_method(mesh, "cells_after", "marks, *, scheme='8t', closure='longest-edge'",
               &predicted_count,
               "Collective. int: how many cells the whole mesh would have after refine() with "
               "these arguments. Marks as for refine().");
    def_method(mesh, "marks_within", "marks, count, *, scheme='8t', closure='longest-edge'",
               &reduced_marks,
               "Collective. bool (cells,): those of the marked cells with the longest edges, as "
               "many as refine() can refine without making more than `count` cells of the whole "
               "mesh. The same cells on any number of ranks.");
    py::class_<MeshFit> fit(
        module, "Fit",
        "Fit(mesh, *, scheme='8t', closure='longest-edge', levels=50, max_cells=None): refinement "
        "and coarsening of a mesh until its cells have a target size:\n\n"
        "    fit = octetra.Fit(mesh)\n"
        "    while step := fit.next(mesh.cell_values(\"0.02 + distance(wall) / 4\")):\n"
        "        u = step.transfer_vertices(u)\n\n"
        "Cells with an edge longer than the size are refined; cells whose longest edge is at most "
        "half the size are merged where possible; cells that are then longer than their size are "
        "refined again. The mesh may be rebalanced between the steps, but not changed otherwise. "
        "As octetra fit.");
    const Signature signature("Fit",
                              "mesh, *, scheme='8t', closure='longest-edge', levels=50, "
                              "max_cells=None");
    fit.def(py::init([signature](const py::args& positional, const py::kwargs& named) {
                return make_fit(Arguments(signature, positional, named));
            }),
            "__init__(self, mesh, *, scheme='8t', closure='longest-edge', levels=50, "
            "max_cells=None)\n--\n\n"
            "Collective. levels: the most steps that refine in a sequence, and that coarsen in "
            "total. scheme, closure, max_cells: as for Mesh.refine().");
    def_method(fit, "next", "sizes", &next_step,
               "Collective. Performs the next step, and returns its Adaptation, or None on all "
               "ranks when the mesh fits. sizes: (cells,), the target size of each cell of this "
               "rank in the present mesh, above 0.");
    def_method(fit, "misfit_cells", "sizes", &counts_of_misfits,
               "Collective. {str: int}: how many cells of the whole mesh have a longest edge above "
               "the size, 'too_long', or below half of it, 'too_short', and how many of the latter "
               "are cells of the input, 'too_short_roots'.");
    fit.def_property_readonly(
           "refined", [](const MeshFit& f) { return f.fit ? f.fit->refined() : 0; },
           "int: the number of steps so far that refined.")
        .def_property_readonly(
            "coarsened", [](const MeshFit& f) { return f.fit ? f.fit->coarsened() : 0; },
            "int: the number of steps so far that coarsened.");
}

}  // namespace octetra::python
