#include <algorithm>

#include <octetra/core/standard_arithmetic.hpp>
#include <octetra/reference/history.hpp>

#include "bisect.hpp"
#include "closure.hpp"

namespace octetra::reference {
namespace {

using VertexSet = IndexVector<VertexIndex, char>;

/// A mesh before a step, and the midpoints that the step made of its edges.
struct Step {
    const Mesh* mesh;
    const std::vector<EdgeVertices>* edges;
    EdgeTable table = number_edges(*mesh);
    EdgeToMidpoint midpoints = midpoints_of(*edges, table, *mesh);

    [[nodiscard]] bool cuts(CellIndex c) const {
        return std::ranges::any_of(table.cell_to_edges[c],
                                   [&](EdgeIndex e) { return !midpoints[e].is_none(); });
    }
};

/// Implements rule (a) of coarsened().
VertexSet vertices_to_keep(const Mesh& input, const Mesh& present, const CellMarks& may_coarsen,
                           const std::vector<Step>& steps) {
    VertexSet kept(present.points.size(), false);
    std::fill_n(kept.begin(), input.points.size(), true);
    const auto keep = [&](const CellVertices& cell) {
        for (const VertexIndex v : cell) kept[v] = true;
    };
    for (CellIndex c{0}; c < present.cells.end_index(); ++c) {
        if (may_coarsen[c] == 0) keep(present.cells[c]);
    }
    for (const Step& step : steps) {
        for (CellIndex c{0}; c < step.mesh->cells.end_index(); ++c) {
            if (step.cuts(c)) keep(step.mesh->cells[c]);
        }
    }
    return kept;
}

/// Implements rule (b) of coarsened(), the rule of closure, within each step.
void keep_closed(const Step& step, VertexSet& kept) {
    EdgeSet kept_edges(step.table.edges.size(), false);
    for (EdgeIndex e{0}; e < kept_edges.end_index(); ++e) {
        kept_edges[e] = !step.midpoints[e].is_none() && kept[step.midpoints[e]] != 0;
    }
    kept_edges = close(kept_edges, *step.mesh, step.table);
    for (EdgeIndex e{0}; e < kept_edges.end_index(); ++e) {
        if (kept_edges[e] != 0) kept[step.midpoints[e]] = true;
    }
}

/// Implements rule (c) of coarsened() for the cells that `step` cut; `next` is the following step.
void keep_complete(const Step& step, const Step& next, VertexSet& kept) {
    CellIndex child{0};
    for (CellIndex c{0}; c < step.mesh->cells.end_index(); ++c) {
        const auto pieces = pieces_of(step.mesh->cells[c], *step.mesh, step.table, step.midpoints);
        bool has_kept = false;
        for (std::size_t k = 0; k < pieces.size(); ++k, ++child) {
            for (const EdgeIndex e : next.table.cell_to_edges[child]) {
                const VertexIndex midpoint = next.midpoints[e];
                has_kept = has_kept || (!midpoint.is_none() && kept[midpoint] != 0);
            }
        }
        if (!has_kept || pieces.size() == 1) continue;
        for (const EdgeIndex e : step.table.cell_to_edges[c]) {
            if (!step.midpoints[e].is_none()) kept[step.midpoints[e]] = true;
        }
    }
}

/// Returns the history without the midpoints that are not kept. The remaining ones are renumbered
/// consecutively, as replay will number them; their order does not change, so edges remain
/// ascending.
History without(const History& history, const VertexSet& kept) {
    History rest{history.input, {}};
    IndexVector<VertexIndex, VertexIndex> new_number(kept.size(), VertexIndex::none());
    VertexIndex next{0};
    for (; next < history.input.points.end_index(); ++next) new_number[next] = next;
    VertexIndex midpoint = next;
    for (const auto& step : history.steps) {
        std::vector<EdgeVertices> left;
        for (const auto& [a, b] : step) {
            if (kept[midpoint] != 0) {
                left.push_back({new_number[a], new_number[b]});
                new_number[midpoint] = next;
                ++next;
            }
            ++midpoint;
        }
        if (!left.empty()) rest.steps.push_back(left);
    }
    return rest;
}

}  // namespace

History coarsened(const History& history, const CellMarks& may_coarsen, Closure closure) {
    const StandardArithmetic standard;
    const std::vector<Refinement> meshes = replay(history);
    std::vector<Step> steps;
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        steps.push_back({&meshes[t].mesh, &history.steps[t]});
    }
    VertexSet kept = vertices_to_keep(history.input, meshes.back().mesh, may_coarsen, steps);
    for (std::size_t t = steps.size(); t-- > 0;) {
        if (closure == Closure::regular && t + 1 < steps.size()) {
            keep_complete(steps[t], steps[t + 1], kept);
        }
        keep_closed(steps[t], kept);
    }
    return without(history, kept);
}

}  // namespace octetra::reference
