#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bind.hpp"
#include "migration.hpp"
#include "step_options.hpp"

namespace octetra::python {

od::StepOptions step_options(const py::object& given, const py::object& closure,
                             const py::object& max_cells) {
    od::StepOptions options;
    options.closure = closure_from("closure", closure);
    const std::string scheme = string_from("scheme", given);
    if (scheme == "4t") {
        options.scheme = Scheme::four;
    } else if (scheme == "2t") {
        options.scheme = Scheme::two;
    } else if (scheme != "8t") {
        throw InputError(fmt::format("scheme must be '8t', '4t' or '2t', not '{}'", scheme));
    }
    if (!max_cells.is_none()) {
        options.max_cells = integer_from<std::uint64_t>("max_cells", max_cells);
    }
    return options;
}

namespace {

using Adaptation = std::shared_ptr<od::Adaptation>;

Marks marked(const Mesh& mesh, const py::object& marks, const py::object& cells) {
    if (cells.is_none()) return marks_of(marks, mesh.cell_count());
    if (!marks.is_none())
        throw InputError("marks and cells are alternatives: one of them must be None");
    return marks_of_list(cells, mesh.cell_count());
}

Adaptation shared(od::Adaptation step) { return std::make_shared<od::Adaptation>(std::move(step)); }

Adaptation refine(Mesh& mesh, const Arguments& arguments) {
    Marks which;
    od::StepOptions options;
    return mesh.change_when_asked(
        [&] {
            const auto [marks, cells, scheme, closure, max_cells] = arguments.values<5>();
            which = marked(mesh, marks, cells);
            options = step_options(scheme, closure, max_cells);
        },
        [&](od::AdaptiveMesh& now, const auto& convert) {
            return shared(now.refine([&] {
                convert();
                return od::StepRequest{which.bytes, options};
            }));
        });
}

Adaptation refine_edges(Mesh& mesh, const Arguments& arguments) {
    std::vector<EdgeVertices> edges;
    od::StepOptions options;
    return mesh.change(
        [&] {
            const auto [given, scheme, max_cells] = arguments.values<3>();
            edges = values_of<EdgeVertices>("edges", given);
            options = step_options(scheme, py::str("longest-edge"), max_cells);
        },
        [&](od::AdaptiveMesh& now) { return shared(now.refine_edges(edges, options)); });
}

Adaptation coarsen(Mesh& mesh, const Arguments& arguments) {
    Marks which;
    return mesh.change(
        [&] {
            const auto [marks, cells] = arguments.values<2>();
            which = marked(mesh, marks, cells);
        },
        [&](od::AdaptiveMesh& now) { return shared(now.coarsen(which.bytes)); });
}

/// The numbers of cells and vertices before a migration, which the caller adds.
Moved moved(const od::AdaptiveMesh& mesh) {
    return {mesh.processes(), mesh.cells().size(), mesh.points().size(), {}};
}

od::BalanceOptions balance_options(const py::object& most_over_mean,
                                   const py::object& may_forget_history) {
    return {.most_over_mean = number_from("most_over_mean", most_over_mean),
            .may_forget_history = boolean_from("may_forget_history", may_forget_history)};
}

Moved rebalance(Mesh& mesh, const Arguments& arguments) {
    od::BalanceOptions options;
    return mesh.change(
        [&] {
            const auto [most_over_mean, may_forget_history] = arguments.values<2>();
            options = balance_options(most_over_mean, may_forget_history);
        },
        [&](od::AdaptiveMesh& now) {
            Moved move = moved(now);
            move.migration = now.rebalance(options);
            return move;
        });
}

Moved recall_history(Mesh& mesh, const Arguments& arguments) {
    return mesh.change([&] { arguments.check(); },
                       [&](od::AdaptiveMesh& now) {
                           Moved move = moved(now);
                           move.migration = now.recall_history();
                           return move;
                       });
}

Moved migrate(Mesh& mesh, const Arguments& arguments) {
    std::vector<std::int32_t> ranks;
    return mesh.change(
        [&] { ranks = values_of<std::int32_t>("rank_of_root", arguments.values<1>()[0]); },
        [&](od::AdaptiveMesh& now) {
            Moved move = moved(now);
            move.migration = now.migrate(ranks);
            return move;
        });
}

std::tuple<Moved, Adaptation> refine_evenly(Mesh& mesh, const Arguments& arguments) {
    Marks which;
    od::StepOptions options;
    od::BalanceOptions balance;
    return mesh.change(
        [&] {
            const auto [marks, cells, most_over_mean, may_forget_history, scheme, closure,
                        max_cells] = arguments.values<7>();
            which = marked(mesh, marks, cells);
            options = step_options(scheme, closure, max_cells);
            balance = balance_options(most_over_mean, may_forget_history);
        },
        [&](od::AdaptiveMesh& now) {
            Moved move = moved(now);
            od::EvenStep step = now.refine_evenly(which.bytes, balance, options);
            move.migration = std::move(step.move);
            return std::tuple(std::move(move), shared(std::move(step.step)));
        });
}

}  // namespace

void bind_steps(py::module_&, MeshClass& mesh) {
    def_method(mesh, "refine",
               "marks=None, *, cells=None, scheme='8t', closure='longest-edge', max_cells=None",
               &refine,
               "Collective. Refines the marked cells, and those that closure adds, by one step of "
               "8T-LE refinement. Returns an Adaptation.\n\n"
               "marks: (cells,), booleans, or integers that are 0 or one other value, which means "
               "true; None marks no cell of this rank. cells: instead of marks, the numbers of "
               "marked cells of this rank, in any order. scheme: '8t', '4t' or '2t'. closure: "
               "'longest-edge', or 'regular', which bounds the angles of all later refinements: it "
               "requires scheme '8t', and a mesh is refined with one closure only. max_cells: a "
               "step after which the whole mesh would have more cells is refused; None means no "
               "limit.");
    def_method(mesh, "refine_edges", "edges, *, scheme='8t', max_cells=None", &refine_edges,
               "Collective. Bisects edges, and those that closure adds, in one step. Returns an "
               "Adaptation.\n\n"
               "edges: (n, 2), vertices of this rank. An edge is bisected if one of the ranks that "
               "have it passes it. scheme, max_cells: as for refine().");
    def_method(mesh, "refine_evenly",
               "marks=None, *, cells=None, most_over_mean=1.1, may_forget_history=False, "
               "scheme='8t', closure='longest-edge', max_cells=None",
               &refine_evenly,
               "Collective. Moves cells between ranks such that all ranks have nearly the same "
               "number of cells after the step, and then refines as refine() does. Returns the "
               "Migration and the Adaptation.\n\n"
               "most_over_mean: as for rebalance(). may_forget_history: if the descendants of "
               "single input cells are too many for even parts, cells of the present mesh may "
               "replace the input cells as roots. Coarsening cannot merge these until "
               "recall_history() restores the history. Other arguments as for refine().");
    def_method(mesh, "coarsen", "marks=None, *, cells=None", &coarsen,
               "Collective. Reverses refinement by one generation: marked cells are merged into "
               "the cell from which they were bisected where the mesh remains conforming. Returns "
               "an Adaptation. Marks as for refine().");
    def_method(mesh, "rebalance", "*, most_over_mean=1.1, may_forget_history=False", &rebalance,
               "Collective. Moves cells between ranks if a rank has more than most_over_mean times "
               "the mean number of cells. Returns a Migration. may_forget_history: as for "
               "refine_evenly().");
    mesh.def_property_readonly(
        "has_forgotten_history", [](const Mesh& m) { return m.now().has_forgotten_history(); },
        "bool: whether may_forget_history has made cells of a refined mesh the roots. The same on "
        "all ranks.");
    def_method(mesh, "recall_history", "", &recall_history,
               "Collective. Restores the roots, and the history, from before the last time that "
               "may_forget_history replaced the roots. Cells move to the ranks that own the "
               "restored roots. Returns a Migration.");
    def_method(mesh, "migrate", "rank_of_root", &migrate,
               "Collective. Moves each root with its descendants to a given rank. Returns a "
               "Migration. rank_of_root: (roots,), the rank for each of `roots`.");
}

}  // namespace octetra::python
