#include "properties/histories/draw_history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <octetra/core/orientation.hpp>

#include "properties/draw_case.hpp"
#include "properties/histories/reference_history.hpp"
#include "properties/histories/rewriting.hpp"

namespace octetra::properties {
namespace {

Selection share(double fraction, Draw& draw) {
    return {.random = RandomShare{std::min(fraction, 1.0), draw.any()}};
}

/// Selects about one to three cells of a mesh of this size.
Selection few_cells(std::size_t cell_count, Draw& draw) {
    return share(draw.between(1, 3) / static_cast<double>(cell_count), draw);
}

Selection any_cells(const Mesh& input, Draw& draw) {
    Selection selection;
    add_criterion(selection, input, draw);
    for (Sphere& sphere : selection.spheres) sphere.radius *= std::ldexp(1.0, -draw.between(0, 3));
    return selection;
}

/// Mostly sparse, because refining all cells soon reaches the maximum size.
Selection cells_to_refine(const Mesh& input, std::size_t cell_count, Draw& draw) {
    if (draw.chance(0.6)) return few_cells(cell_count, draw);
    return any_cells(input, draw);
}

/// Mostly many, because few marks seldom allow any coarsening.
Selection cells_to_coarsen(const Mesh& input, Draw& draw) {
    switch (draw.below(8)) {
        case 0: return {.all = true};
        case 1:
        case 2:
        case 3:
        case 4: return share(1 - 0.3 * draw.unit(), draw);
        case 5: return share(draw.unit(), draw);
        default: return any_cells(input, draw);
    }
}

Step refinement(const Mesh& input, std::size_t cell_count, Draw& draw) {
    constexpr std::array schemes{Scheme::eight, Scheme::four, Scheme::two};
    return {.action = Action::refine,
            .selection = cells_to_refine(input, cell_count, draw),
            .scheme = schemes[draw.below(3)]};
}

/// A cell hardly thicker than the spacing of floating-point numbers, at a distance where only whole
/// numbers are representable.
Mesh far_out_sliver(Draw& draw) {
    while (true) {
        Corners p;
        for (Point& corner : p) {
            corner = {0x1p52 + draw.between(0, 63), 0x1p52 + draw.between(0, 63),
                      0x1p52 + draw.between(0, 3)};
        }
        const int sign = orientation(p[0], p[1], p[2], p[3]);
        if (sign == 0) continue;
        if (sign < 0) std::swap(p[2], p[3]);
        Mesh mesh;
        for (const Point& corner : p) mesh.points.append(corner);
        mesh.cells.append({VertexIndex{0U}, VertexIndex{1U}, VertexIndex{2U}, VertexIndex{3U}});
        return mesh;
    }
}

/// A cell that could be cut into eight but not into fewer: usually the coarsening of some of its
/// children is refused because of rounding.
Case draw_sliver(Draw& draw, int ranks) {
    Case c{.kind = "a far-out sliver"};
    c.cell_to_rank = {draw.between(0, ranks - 1)};
    c.seed = draw.any();
    for (int tries = 0; tries < 400; ++tries) {
        c.mesh = far_out_sliver(draw);
        c.steps = {{.action = Action::refine, .selection = {.all = true}},
                   {.action = Action::coarsen, .selection = share(draw.unit(), draw)}};
        if (!adapted_by_reference(c).stages.back().refusal.empty()) break;
    }
    return c;
}

Case draw_start(Draw& draw, int size, int ranks, bool exact) {
    if (!exact && draw.chance(0.15)) return draw_sliver(draw, ranks);
    Case c = draw_case(draw, size, ranks, exact);
    c.selection = {};
    c.scheme = Scheme::eight;
    c.closure = Closure::longest_edge;
    c.levels = 1;
    const std::size_t cells = c.mesh.cells.size();
    if (draw.chance(0.4) && 8 * cells < max_history_cells) {
        // In a mesh of this size ranks may use the incremental level.
        c.steps = {{.action = Action::refine, .selection = {.all = true}},
                   {.action = Action::refine, .selection = few_cells(8 * cells, draw)}};
    } else {
        c.steps = {refinement(c.mesh, cells, draw), refinement(c.mesh, cells, draw)};
    }
    return c;
}

}  // namespace

Case draw_history(Draw& draw, int size, int ranks, bool exact) {
    Case c = draw_start(draw, size, ranks, exact);
    const std::size_t cells = adapted_by_reference(c).stages.back().mesh.cells.size();
    for (int left = draw.between(0, 6 + size / 25); left > 0; --left) {
        const bool has_refined = c.steps.back().action == Action::refine;
        const bool has_taken_back = c.steps.back().action == Action::take_back;
        const std::size_t kind = draw.below(24);
        if (has_taken_back && kind < 16) {
            c.steps.push_back({.action = Action::again});
        } else if (has_refined && kind < 4) {
            c.steps.push_back({.action = Action::take_back});
        } else if (kind < 10) {
            c.steps.push_back(refinement(c.mesh, cells, draw));
        } else if (kind < 17) {
            c.steps.push_back(
                {.action = Action::coarsen, .selection = cells_to_coarsen(c.mesh, draw)});
        } else if (kind < 20) {
            c.steps.push_back({.action = Action::reload, .ranks = draw.between(1, ranks)});
        } else if (kind < 23) {
            c.steps.push_back({.action = draw.chance(0.6) ? Action::scatter : Action::rebalance});
        } else {
            c.steps.push_back({.action = Action::rewrite,
                               .format = formats()[draw.below(formats().size())].name});
        }
    }
    return draw.chance(0.3) ? regular(std::move(c)) : c;
}

const std::vector<std::string>& all_tags_of_histories() {
    static const std::vector<std::string> tags{"coarser",
                                               "partly coarser",
                                               "finer after coarser",
                                               "sparse step",
                                               "full step",
                                               "three generations",
                                               "fewer ranks",
                                               "taken back and again",
                                               "refused for size",
                                               "refinement refused for rounding",
                                               "coarsening refused for rounding",
                                               "moved",
                                               "changed after moving",
                                               "written and read",
                                               "changed after reading",
                                               "coarser and regular"};
    return tags;
}

std::vector<std::string> tags_of_history(const Case& c, int ranks) {
    const ReferenceHistory history = adapted_by_reference(c);
    std::vector<bool> is(all_tags_of_histories().size(), false);
    std::size_t cells = c.mesh.cells.size();
    std::size_t points = c.mesh.points.size();
    for (std::size_t k = 0; k < c.steps.size(); ++k) {
        const auto& [mesh, changed, refusal] = history.stages[k];
        const Action action = c.steps[k].action;
        const bool coarsens = action == Action::coarsen || action == Action::take_back;
        const bool refines = action == Action::refine || action == Action::again;
        const auto marked = static_cast<std::size_t>(
            std::ranges::count_if(history.marked[k], [](char mark) { return mark != 0; }));
        const bool by_size = refusal.starts_with("level") || refusal.starts_with("the step");
        is[2] = is[2] || (is[0] && refines && changed);
        is[0] = is[0] || (coarsens && changed);
        is[1] = is[1] || (action == Action::coarsen && changed && marked < cells);
        is[3] = is[3] || (refines && changed && 64 * marked < points);
        is[4] = is[4] || (refines && changed && 2 * marked > cells);
        is[5] = is[5] || history.before[k].steps.size() > 2;
        is[6] = is[6] || (action == Action::reload && c.steps[k].ranks < ranks);
        is[7] = is[7] || (action == Action::again && changed);
        is[8] = is[8] || by_size;
        is[9] = is[9] || (refines && !refusal.empty() && !by_size);
        is[10] = is[10] || (coarsens && !refusal.empty());
        is[12] = is[12] || (is[11] && changed);
        is[11] = is[11] || action == Action::scatter || action == Action::rebalance;
        is[14] = is[14] || (is[13] && changed);
        is[13] = is[13] || action == Action::rewrite;
        is[15] = is[0] && c.closure == Closure::regular;
        cells = mesh.cells.size();
        points = mesh.points.size();
    }
    std::vector<std::string> tags;
    for (std::size_t i = 0; i < is.size(); ++i) {
        if (is[i]) tags.push_back(all_tags_of_histories()[i]);
    }
    return tags;
}

}  // namespace octetra::properties
