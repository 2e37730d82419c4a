#include <algorithm>

#include "closure.hpp"  // the reference's own, to close a closed set once more
#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/one_level.hpp"
#include "properties/team.hpp"

namespace octetra::properties {
namespace {

Edges bisected(const Outcome& outcome) {
    return {outcome.maps.midpoint_to_edge.begin(), outcome.maps.midpoint_to_edge.end()};
}

/// The same case with one to three more cells marked.
Case with_more_marked(Case c, Draw& draw) {
    for (int i = draw.between(1, 3); i > 0; --i) {
        c.selection.cells.push_back(GlobalCell{draw.below(c.mesh.cells.size())});
    }
    std::ranges::sort(c.selection.cells);
    const auto doubles = std::unique(c.selection.cells.begin(), c.selection.cells.end());
    c.selection.cells.erase(doubles, c.selection.cells.end());
    return c;
}

Edges closed_by_the_reference(const Mesh& mesh, const Edges& edges) {
    const reference::EdgeTable table = reference::number_edges(mesh);
    reference::EdgeSet set(table.edges.size(), 0);
    for (const auto& [a, b] : edges) set[reference::find_edge(table, a, b)] = 1;
    set = reference::close(std::move(set), mesh, table);
    Edges result;
    for (EdgeIndex e{0}; e < set.end_index(); ++e) {
        if (set[e] != 0) result.insert(table.edges[e]);
    }
    return result;
}

}  // namespace

std::string fault_of_closure(const Case& any_levels) {
    Case c = any_levels;
    c.levels = 1;
    const Outcome outcome = refined_by_all(c);
    if (!outcome.error.empty()) return {};
    const Edges found = bisected(outcome);

    Edges direct;
    for (CellIndex i{0}; i < c.mesh.cells.end_index(); ++i) {
        if (is_marked(c, i)) direct.merge(marked_by(c, i));
    }
    const Edges expected = closure_of(c.mesh, std::move(direct));
    if (!std::ranges::includes(found, expected)) return "an edge is missing in the closure";
    if (found != expected) return "an edge of the closure could be left out";
    if (closed_by_the_reference(c.mesh, found) != found) return "closing again adds edges";

    Draw draw(c.seed);
    const Outcome more = refined_by_all(with_more_marked(c, draw));
    if (!more.error.empty()) return {};
    if (!std::ranges::includes(bisected(more), found)) return "more marked cells, but fewer edges";
    return {};
}

}  // namespace octetra::properties
