#include "coarsening/kept_vertices.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/select_cells.hpp>

namespace octetra::verify {
namespace {

using Why = Reason::Why;

/// Applies rule (a).
void keep_by_cells(const Lineage& lineage, const std::vector<PresentCell>& present,
                   const std::vector<char>& may_coarsen, Reasons& reasons) {
    for (std::size_t c = 0; c < present.size(); ++c) {
        const CellVertices& cell = present[c].vertices;
        int latest = 0;
        for (const VertexIndex v : cell) latest = std::max(latest, lineage.step[v]);
        for (const VertexIndex v : cell) {
            if (reasons[v].why != Why::none) continue;
            if (may_coarsen[c] == 0) {
                reasons[v] = {Why::cell, cell, {}};
            } else if (lineage.step[v] < latest) {
                reasons[v] = {Why::cut, cell, {}};
            }
        }
    }
}

/// If `shorter` is kept, so is `longer`.
struct Pull {
    VertexIndex shorter;
    VertexIndex longer;
    friend auto operator<=>(const Pull&, const Pull&) = default;
};

bool share_a_corner(const EdgeVertices& e, const EdgeVertices& f) {
    return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

/// Returns the pulls between all joined midpoints of one step on edges of one face.
std::vector<Pull> pulls_between(const Lineage& lineage, const std::vector<PresentCell>& present) {
    std::vector<Pull> pulls;
    for (const PresentCell& cell : present) {
        for (const auto& [i, j] : cell_edges) {
            const VertexIndex v = cell.vertices[i];
            const VertexIndex w = cell.vertices[j];
            if (lineage.step[v] != lineage.step[w] || lineage.step[v] == 0) continue;
            const EdgeVertices& e = lineage.halves[v];
            const EdgeVertices& f = lineage.halves[w];
            if (!share_a_corner(e, f)) continue;
            const auto& p = lineage.points;
            const bool first = longer({p[e[0]], p[e[1]]}, {p[f[0]], p[f[1]]});
            pulls.push_back(first ? Pull{w, v} : Pull{v, w});
        }
    }
    std::sort(pulls.begin(), pulls.end());
    pulls.erase(std::unique(pulls.begin(), pulls.end()), pulls.end());
    return pulls;
}

/// Applies rule (b): propagates from midpoints to midpoints of longer edges.
void keep_by_closure(const std::vector<Pull>& pulls, Reasons& reasons) {
    std::vector<VertexIndex> left;
    for (VertexIndex v{0}; v < reasons.end_index(); ++v) {
        if (reasons[v].why != Why::none) left.push_back(v);
    }
    while (!left.empty()) {
        const VertexIndex v = left.back();
        left.pop_back();
        const auto first = std::lower_bound(pulls.begin(), pulls.end(), Pull{v, VertexIndex{0}});
        for (auto pull = first; pull != pulls.end() && pull->shorter == v; ++pull) {
            if (reasons[pull->longer].why != Why::none) continue;
            reasons[pull->longer] = {Why::closure, {}, v};
            left.push_back(pull->longer);
        }
    }
}

/// Applies rule (c) once; returns whether it keeps any further vertex. Children follow the cells
/// from which they were created.
bool keep_by_children(const Lineage& lineage, const std::vector<CutCell>& cut, Reasons& reasons) {
    const auto midpoints_of = [&](const CellVertices& cell, auto&& visit) {
        for (const auto& [i, j] : cell_edges) {
            const std::uint32_t midpoint = lineage.midpoints.find(cell[i], cell[j]);
            if (midpoint != EdgeTable::absent) visit(VertexIndex{midpoint});
        }
    };
    bool changed = false;
    for (auto child = cut.rbegin(); child != cut.rend(); ++child) {
        if (child->parent == no_parent) continue;
        VertexIndex kept = VertexIndex::none();
        midpoints_of(child->vertices, [&](VertexIndex v) {
            if (reasons[v].why != Why::none) kept = v;
        });
        if (kept.is_none()) continue;
        midpoints_of(cut[child->parent].vertices, [&](VertexIndex v) {
            if (reasons[v].why != Why::none) return;
            reasons[v] = {Why::child, child->vertices, kept};
            changed = true;
        });
    }
    return changed;
}

std::vector<char> marked_cells(const Lineage& lineage, const Mesh& input,
                               const std::vector<PresentCell>& present,
                               const CoarseningRequest& request) {
    Selection criteria = request.may_coarsen;
    const std::vector<GlobalCell> listed = std::exchange(criteria.cells, {});
    std::vector<char> marked(present.size(), 0);
    for (const GlobalCell c : listed) {
        if (static_cast<std::uint64_t>(c) >= present.size()) {
            throw InputError(fmt::format("cell {} is listed, from 0, but the mesh before has {}",
                                         static_cast<std::uint64_t>(c), present.size()));
        }
        marked[static_cast<std::size_t>(c)] = 1;
    }
    const auto cell_to_test = [&](std::size_t c) {
        CellToTest cell;
        for (std::size_t k = 0; k < 4; ++k)
            cell.corners[k] = lineage.points[present[c].vertices[k]];
        const CellIndex root = present[c].root;
        cell.region = input.regions.empty() ? 0 : input.regions[root];
        cell.root = GlobalCell{root.value()};
        return cell;
    };
    const SelectedCells selected = select_cells(criteria, present.size(), cell_to_test, {});
    if (!selected.undefined.empty()) {
        const auto& [cell, expression] = std::ranges::min(selected.undefined);
        refuse_undefined(criteria, expression, input.index_base + cell);
    }
    for (std::size_t c = 0; c < present.size(); ++c) {
        if (selected.marks[c] != 0) marked[c] = 1;
        if (request.outside) marked[c] = marked[c] == 0 ? 1 : 0;
    }
    return marked;
}

VertexSet kept_set(const Reasons& reasons) {
    VertexSet stay;
    for (const Reason& reason : reasons) stay.push_back(reason.why == Why::none ? 0 : 1);
    return stay;
}

}  // namespace

Reasons keep_reasons(const Lineage& lineage, const Generations& cells,
                     const std::vector<char>& may_coarsen, Closure closure) {
    Reasons reasons(lineage.points.size());
    for (VertexIndex v{0}; v < reasons.end_index(); ++v) {
        if (lineage.step[v] == 0) reasons[v].why = Why::input;
    }
    keep_by_cells(lineage, cells.present, may_coarsen, reasons);
    const std::vector<Pull> pulls = pulls_between(lineage, cells.present);
    do {
        keep_by_closure(pulls, reasons);
    } while (closure == Closure::regular && keep_by_children(lineage, cells.cut, reasons));
    return reasons;
}

Remainder remainder_of(const Lineage& lineage, const Mesh& input,
                       const CoarseningRequest& request) {
    if (request.levels > 1 && !request.may_coarsen.cells.empty()) {
        throw InputError("a list of cells allows only one level");
    }
    Remainder rest{Reasons(lineage.points.size(), {Why::input, {}, {}}), lineage.cells};
    for (int level = 0; level < request.levels; ++level) {
        const auto may_coarsen = marked_cells(lineage, input, rest.cells.present, request);
        Reasons reasons = keep_reasons(lineage, rest.cells, may_coarsen, request.closure);
        const VertexSet stay = kept_set(reasons);
        const bool all_stay = stay == kept_set(rest.reasons);
        rest.reasons = std::move(reasons);
        if (all_stay) break;
        rest.cells = cells_with(lineage, input, stay);
    }
    return rest;
}

}  // namespace octetra::verify
