#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <octetra/verify/verify.hpp>

#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/bits.hpp"
#include "support/refinement.hpp"
#include "verify/verdicts.hpp"

/// The laws of Closure::regular, for histories drawn with any closure.
namespace octetra::properties {
namespace {

using reference::History;

/// The history after all steps of the case.
History history_after(Case c) {
    c.steps.push_back({.action = Action::reload});
    return adapted_by_reference(c).before.back();
}

/// Two to five cells, most of them near one another.
std::vector<CellIndex> some_cells(const Mesh& mesh, Draw& draw) {
    std::vector<CellIndex> cells{CellIndex{draw.below(mesh.cells.size())}};
    const auto is_near = [&](CellIndex c) {
        const CellVertices& from = mesh.cells[cells.front()];
        return std::ranges::find_first_of(mesh.cells[c], from) != mesh.cells[c].end();
    };
    for (int left = draw.between(1, 4); left > 0; --left) {
        CellIndex cell{draw.below(mesh.cells.size())};
        if (draw.chance(0.8)) {
            while (!is_near(cell)) cell = CellIndex{(cell.value() + 1) % mesh.cells.size()};
        }
        if (std::ranges::find(cells, cell) == cells.end()) cells.push_back(cell);
    }
    return cells;
}

/// Selects the cell with these corners, and no other one of its mesh if the mesh is exact.
Selection only(const Corners& corners) { return {.spheres = {{centroid(corners), 0x1p-40}}}; }

/// The case followed by refinements that mark cells in turn, and by one that marks them together.
struct TwoOrders {
    Case in_turn;
    Case together;
};

/// A cell that the marks of others bisect is marked in neither case.
TwoOrders two_orders(const Case& c, Draw& draw) {
    TwoOrders orders{c, c};
    Step& together = orders.together.steps.emplace_back();
    History history = history_after(c);
    const Mesh before = reference::replay(history).back().mesh;
    for (const CellIndex cell : some_cells(before, draw)) {
        const Selection selection = only(test::corners_of(before, cell));
        const auto marks = reference::marked_cells(reference::replay(history).back(), selection);
        if (std::ranges::count(marks, 1) != 1) continue;
        history = reference::refined_regularly(history, marks);
        orders.in_turn.steps.push_back({.action = Action::refine, .selection = selection});
        together.selection.spheres.push_back(selection.spheres.front());
    }
    for (Case* each : {&orders.in_turn, &orders.together}) {
        each->steps.push_back({.action = Action::reload});
    }
    return orders;
}

bool refuses(const Adapted& adapted, std::size_t first_step) {
    return std::any_of(adapted.stages.begin() + static_cast<std::ptrdiff_t>(first_step),
                       adapted.stages.end(), [](const Stage& s) { return !s.refusal.empty(); });
}

}  // namespace

std::string fault_of_order_of_marks(const Case& drawn) {
    const Case c = regular(drawn);
    Draw draw(c.seed);
    const TwoOrders orders = two_orders(c, draw);
    const Adapted in_turn = adapted_by_all(orders.in_turn);
    const Adapted together = adapted_by_all(orders.together);
    if (refuses(in_turn, c.steps.size()) || refuses(together, c.steps.size())) return {};
    const Mesh& one = in_turn.stages.back().mesh;
    const Mesh& other = together.stages.back().mesh;
    if (!(one == other) || test::bits(one) != test::bits(other)) {
        return "marking cells in turn makes another mesh than marking them together";
    }
    if (in_turn.checkpoint != together.checkpoint) {
        return "marking cells in turn makes another history than marking them together";
    }
    return {};
}

std::string fault_of_regular_families(const Case& drawn) {
    Case c = regular(without_rewrites(drawn));
    Draw draw(c.seed);
    for (const double least : {0.0, 0.7}) {
        const double fraction = least + (1 - least) * draw.unit();
        c.steps.push_back({.action = Action::coarsen,
                           .selection = {.random = RandomShare{fraction, draw.any()}}});
    }
    const Adapted adapted = adapted_by_all(c);
    for (std::size_t k = 0; k < c.steps.size(); ++k) {
        const Stage& stage = adapted.stages[k];
        if (c.steps[k].action != Action::coarsen || !stage.changed) continue;
        const auto verdict =
            verify::verify_refinement(c.mesh, stage.mesh, {.closure = Closure::regular});
        if (verdict.valid()) continue;
        return "step " + std::to_string(k + 1) + ": the verifier finds: " + test::codes_of(verdict);
    }
    return {};
}

}  // namespace octetra::properties
