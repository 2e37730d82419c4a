#include <algorithm>
#include <numeric>

#include <octetra/verify/compare.hpp>

#include "properties/draw.hpp"
#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/refinement.hpp"

namespace octetra::properties {
namespace {

/// The new position of each of `count` items.
std::vector<std::size_t> some_order(std::size_t count, Draw& draw) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    draw.shuffle(order);
    return order;
}

/// new_list[order[i]] = list[i], for groups of `each` entries.
template <class List>
List moved(const List& list, const std::vector<std::size_t>& order, std::size_t each = 1) {
    List result = list;
    for (std::size_t i = 0; i < list.size(); ++i) {
        *(result.begin() + static_cast<std::ptrdiff_t>(order[i / each] * each + i % each)) =
            *(list.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return result;
}

/// Applies one of the twelve permutations of corners that preserve the orientation.
void turn_corners(CellVertices& cell, Draw& draw) {
    std::swap(cell[0], cell[1]);
    std::swap(cell[2], cell[3]);
    const std::size_t fixed = draw.below(4);
    std::swap(cell[0], cell[fixed]);
    if (fixed != 0) std::swap(cell[fixed], cell[fixed == 3 ? 2 : 3]);
    const auto steps = static_cast<std::ptrdiff_t>(draw.below(3));
    std::rotate(cell.begin() + 1, cell.begin() + 1 + steps, cell.end());
}

struct Renumbered {
    Case refinement;
    std::vector<std::size_t> cell_order;
};

Renumbered renumbered(const Case& c, bool corners_too, Draw& draw) {
    Case r = c;
    Mesh& mesh = r.mesh;
    const auto vertex_order = some_order(mesh.points.size(), draw);
    const auto cell_order = some_order(mesh.cells.size(), draw);
    mesh.points = moved(mesh.points, vertex_order);
    if (!mesh.point_markers.empty()) mesh.point_markers = moved(mesh.point_markers, vertex_order);
    if (mesh.attributes_per_point > 0) {
        mesh.point_attributes =
            moved(mesh.point_attributes, vertex_order, mesh.attributes_per_point);
    }
    const auto renumber = [&](auto& list) {
        for (auto& vertices : list) {
            for (VertexIndex& v : vertices) v = VertexIndex{vertex_order[v.value()]};
        }
    };
    renumber(mesh.cells);
    renumber(mesh.facets);
    renumber(mesh.edges);
    if (corners_too) {
        for (CellVertices& cell : mesh.cells) turn_corners(cell, draw);
    }
    mesh.cells = moved(mesh.cells, cell_order);
    if (!mesh.regions.empty()) mesh.regions = moved(mesh.regions, cell_order);
    draw.shuffle(r.cell_to_rank);
    const auto renumber_cells = [&](Selection& selection) {
        for (GlobalCell& cell : selection.cells) {
            cell = GlobalCell{cell_order[static_cast<std::size_t>(cell)]};
        }
        std::ranges::sort(selection.cells);
    };
    renumber_cells(r.selection);
    for (Step& step : r.steps) renumber_cells(step.selection);
    return {std::move(r), cell_order};
}

/// For each cell of the input its children in order, by the coordinates of their corners.
std::vector<std::vector<Corners>> children(const Outcome& outcome, std::size_t parents) {
    std::vector<std::vector<Corners>> result(parents);
    for (CellIndex c{0}; c < outcome.mesh.cells.end_index(); ++c) {
        result[outcome.maps.cell_to_parent[c].value()].push_back(test::corners_of(outcome.mesh, c));
    }
    return result;
}

}  // namespace

std::string fault_of_numbering(const Case& c) {
    Draw draw(c.seed);
    const bool corners_too = draw.chance(0.5);
    const auto [other_case, cell_order] = renumbered(c, corners_too, draw);
    const Outcome one = refined_by_all(c);
    const Outcome other = refined_by_all(other_case);
    if (one.error.empty() != other.error.empty()) {
        return "refused in one numbering only: '" + one.error + other.error + "'";
    }
    if (!one.error.empty()) return {};
    if (verify::compare(one.mesh, other.mesh).likeness == verify::Likeness::different) {
        return "another numbering yields another mesh";
    }
    if (corners_too) return {};
    const std::size_t cells = c.mesh.cells.size();
    if (moved(children(one, cells), cell_order) != children(other, cells)) {
        return "another numbering yields children in another order";
    }
    return {};
}

std::string fault_of_numbering_in_steps(const Case& drawn) {
    const Case c = without_rewrites(drawn);
    Draw draw(c.seed);
    const Case other_case = renumbered(c, draw.chance(0.5), draw).refinement;
    const auto one = adapted_by_all(c).stages;
    const auto other = adapted_by_all(other_case).stages;
    for (std::size_t k = 0; k < one.size(); ++k) {
        if (one[k].refusal.empty() != other[k].refusal.empty()) {
            return "refused in one numbering only: '" + one[k].refusal + other[k].refusal + "'";
        }
        if (one[k].changed != other[k].changed ||
            verify::compare(one[k].mesh, other[k].mesh).likeness == verify::Likeness::different) {
            return "step " + std::to_string(k + 1) + ": another numbering yields another mesh";
        }
    }
    return {};
}

}  // namespace octetra::properties
