#include "properties/coarsened_worlds.hpp"

#include <algorithm>

#include "properties/coarser_meshes.hpp"
#include "support/coarsening.hpp"
#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/nesting.hpp"

namespace octetra::properties {
namespace {

using reference::CellMarks;
using reference::History;
using reference::Refinement;

/// Coordinates are whole numbers of 22 bits, and each of at most eight steps adds a bit.
constexpr double scale = 0x1p8;

bool are_closed(const History& history, const std::vector<Refinement>& meshes) {
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        const auto& edges = history.steps[t];
        if (edges.empty() || !std::ranges::is_sorted(edges)) return false;
        if (!test::is_closed(meshes[t].mesh, edges)) return false;
    }
    return true;
}

bool conforms(const Mesh& mesh) {
    const auto census = test::count_faces(mesh);
    return census.faults == 0 && census.boundary_faces == mesh.facets.size();
}

}  // namespace

std::string fault_of_coarsening(const History& history, const CellMarks& may_coarsen) {
    const History rest = reference::coarsened(history, may_coarsen);
    const auto before = reference::replay(history);
    const auto after = reference::replay(rest);
    const Refinement& old = before.back();
    const Refinement& coarser = after.back();
    if (!are_closed(rest, after)) return "a step is not closed";
    if (test::points_of(coarser.mesh) != test::points_that_stay(history, may_coarsen).all) {
        return "the rules require other vertices";
    }
    if (!has_unmarked_cells(old.mesh, may_coarsen, coarser.mesh)) return "a cell is gone";
    if (!test::refines(old, coarser, scale)) return "the old mesh does not refine the new one";
    if (!coarsens_by_one_generation(before, coarser, scale))
        return "a cell is back by two generations";
    if (!conforms(coarser.mesh)) return "the mesh does not conform";
    return {};
}

std::vector<History> histories_of_one_step(const Mesh& cell) {
    std::vector<History> histories;
    for (EdgeBits bits = 1; bits < 64; ++bits) {
        std::vector<EdgeVertices> edges;
        for (std::size_t e = 0; e < 6; ++e) {
            const CellVertices& v = cell.cells.front();
            const auto [low, high] = std::minmax(v[cell_edges[e][0]], v[cell_edges[e][1]]);
            if ((bits >> e & 1U) != 0) edges.push_back({low, high});
        }
        std::ranges::sort(edges);
        if (test::is_closed(cell, edges)) histories.push_back({cell, {edges}});
    }
    return histories;
}

std::string fault_of_fewer_edges(const History& more, const History& fewer) {
    const Refinement fine = reference::replay(more).back();
    const Refinement coarse = reference::replay(fewer).back();
    if (!test::refines(fine, coarse, scale)) return "the pattern does not refine that of fewer";
    const auto points = test::points_of(coarse.mesh);
    CellMarks has_missing_midpoint;
    for (const CellVertices& child : fine.mesh.cells) {
        has_missing_midpoint.append(std::ranges::any_of(
            child, [&](VertexIndex v) { return !points.contains(fine.mesh.points[v]); }));
    }
    if (!has_unmarked_cells(fine.mesh, has_missing_midpoint, coarse.mesh)) return "a cell is gone";
    return {};
}

History refined_at_random(const History& history, Draw& draw) {
    constexpr std::array schemes{Scheme::eight, Scheme::four, Scheme::two};
    return reference::refined(history, random_marks(history, draw), schemes[draw.below(3)]);
}

CellMarks random_marks(const History& history, Draw& draw) {
    CellMarks marks(reference::replay(history).back().mesh.cells.size(), false);
    const double share = draw.unit();
    for (char& mark : marks) mark = draw.chance(share) ? 1 : 0;
    return marks;
}

}  // namespace octetra::properties
