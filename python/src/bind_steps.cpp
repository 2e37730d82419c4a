#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "migration.hpp"

namespace octetra::python {
namespace {

using Adaptation = std::shared_ptr<od::Adaptation>;

Marks marked(const Mesh& mesh, const py::object& marks, const py::object& cells) {
    if (cells.is_none()) return marks_of(marks, mesh.cell_count());
    if (!marks.is_none()) throw InputError("either marks or cells, not both");
    return marks_of_list(cells, mesh.cell_count());
}

od::StepOptions step_options(const std::string& scheme, const py::object& max_cells) {
    od::StepOptions options;
    if (scheme == "4t") {
        options.scheme = Scheme::four;
    } else if (scheme == "2t") {
        options.scheme = Scheme::two;
    } else if (scheme != "8t") {
        throw InputError("scheme: '8t', '4t' or '2t'");
    }
    if (!max_cells.is_none()) options.max_cells = whole_number("max_cells", max_cells);
    return options;
}

Adaptation shared(od::Adaptation step) { return std::make_shared<od::Adaptation>(std::move(step)); }

Adaptation refine(Mesh& mesh, const py::object& marks, const py::object& cells,
                  const std::string& scheme, const py::object& max_cells) {
    Marks which;
    od::StepOptions options;
    return mesh.change_when_asked(
        [&] {
            which = marked(mesh, marks, cells);
            options = step_options(scheme, max_cells);
        },
        [&](od::AdaptiveMesh& now, const auto& convert) {
            return shared(now.refine([&] {
                convert();
                return od::StepRequest{which.bytes, options};
            }));
        });
}

Adaptation refine_edges(Mesh& mesh, const py::object& given, const std::string& scheme,
                        const py::object& max_cells) {
    std::vector<EdgeVertices> edges;
    od::StepOptions options;
    return mesh.change(
        [&] {
            edges = values_of<EdgeVertices>("edges", given);
            options = step_options(scheme, max_cells);
        },
        [&](od::AdaptiveMesh& now) { return shared(now.refine_edges(edges, options)); });
}

Adaptation coarsen(Mesh& mesh, const py::object& marks, const py::object& cells) {
    Marks which;
    return mesh.change([&] { which = marked(mesh, marks, cells); },
                       [&](od::AdaptiveMesh& now) { return shared(now.coarsen(which.bytes)); });
}

Moved moved(const od::AdaptiveMesh& mesh) {
    return {mesh.processes(), mesh.cells().size(), mesh.points().size(), {}};
}

od::BalanceOptions balance_options(double most_over_mean, bool may_forget_history) {
    return {.most_over_mean = most_over_mean, .may_forget_history = may_forget_history};
}

Moved rebalance(Mesh& mesh, double most_over_mean, bool may_forget_history) {
    return mesh.change([] {},
                       [&](od::AdaptiveMesh& now) {
                           Moved move = moved(now);
                           move.migration =
                               now.rebalance(balance_options(most_over_mean, may_forget_history));
                           return move;
                       });
}

Moved recall_history(Mesh& mesh) {
    return mesh.change([] {},
                       [&](od::AdaptiveMesh& now) {
                           Moved move = moved(now);
                           move.migration = now.recall_history();
                           return move;
                       });
}

Moved migrate(Mesh& mesh, const py::object& given) {
    std::vector<std::int32_t> ranks;
    return mesh.change([&] { ranks = values_of<std::int32_t>("rank_of_root", given); },
                       [&](od::AdaptiveMesh& now) {
                           Moved move = moved(now);
                           move.migration = now.migrate(ranks);
                           return move;
                       });
}

std::tuple<Moved, Adaptation> refine_evenly(Mesh& mesh, const py::object& marks,
                                            const py::object& cells, double most_over_mean,
                                            bool may_forget_history, const std::string& scheme,
                                            const py::object& max_cells) {
    Marks which;
    od::StepOptions options;
    return mesh.change(
        [&] {
            which = marked(mesh, marks, cells);
            options = step_options(scheme, max_cells);
        },
        [&](od::AdaptiveMesh& now) {
            Moved move = moved(now);
            od::EvenStep step = now.refine_evenly(
                which.bytes, balance_options(most_over_mean, may_forget_history), options);
            move.migration = std::move(step.move);
            return std::tuple(std::move(move), shared(std::move(step.step)));
        });
}

}  // namespace

void bind_steps(py::module_&, MeshClass& mesh) {
    const py::arg_v no_marks = py::arg("marks") = py::none();
    const py::arg_v no_cells = py::arg("cells") = py::none();
    const py::arg_v scheme = py::arg("scheme") = "8t";
    const py::arg_v max_cells = py::arg("max_cells") = py::none();
    const py::arg_v most_over_mean = py::arg("most_over_mean") = 1.1;
    const py::arg_v may_forget = py::arg("may_forget_history") = false;
    mesh.def("refine", &refine, no_marks, py::kw_only(), no_cells, scheme, max_cells,
             "Collective. One step of 8T-LE refinement: of the marked cells and what closure "
             "adds.\n\n"
             "marks: (cells,), booleans, or whole numbers of any type, 0 or one other value that "
             "means true; None on a rank that marks nothing. cells, instead: numbers of cells of "
             "this "
             "rank, in any order. scheme: '8t', '4t' or '2t'. A step that would make more than "
             "max_cells cells of the whole mesh is refused.")
        .def(
            "refine_edges", &refine_edges, py::arg("edges"), py::kw_only(), scheme, max_cells,
            "Collective. One step that bisects these edges, (n, 2) vertices of this rank, and what "
            "closure adds. It is enough that one of the ranks which have an edge lists it.")
        .def(
            "refine_evenly", &refine_evenly, no_marks, py::kw_only(), no_cells, most_over_mean,
            may_forget, scheme, max_cells,
            "Collective. refine(), before which cells move to where the step leaves all ranks with "
            "about as many. Returns the Migration and the Adaptation, in this order.\n\n"
            "may_forget_history: where cells of the input with all that has become of them are "
            "too much to make ranks even, cells of the mesh as it is may take their place. They "
            "are the roots then, and coarsening ends with them, until recall_history().")
        .def("coarsen", &coarsen, no_marks, py::kw_only(), no_cells,
             "Collective. Takes refinement back: marked cells may become part of the one that they "
             "were bisected from. Marks as of refine().")
        .def("rebalance", &rebalance, py::kw_only(), most_over_mean, may_forget,
             "Collective. Cells go from ranks that have many to those that have few, where one has "
             "more than most_over_mean times the mean. may_forget_history: see refine_evenly().")
        .def_property_readonly(
            "has_forgotten_history", [](const Mesh& m) { return m.now().has_forgotten_history(); },
            "Has may_forget_history made cells of a refined mesh the roots? The same on all ranks.")
        .def(
            "recall_history", &recall_history,
            "Collective. Where cells of a refined mesh are the roots, takes that back; the last "
            "time, "
            "where it was more than once. Roots go to the ranks on which they were cells, with all "
            "that has become of them, and are descendants again.")
        .def("migrate", &migrate, py::arg("rank_of_root"),
             "Collective. Cells go to where a program wants them: (roots,), the rank that is to "
             "have each of `roots`.");
}

}  // namespace octetra::python
