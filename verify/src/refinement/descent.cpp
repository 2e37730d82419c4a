#include "refinement/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

#include "refinement/cell_divider.hpp"

namespace octetra::verify {
namespace {

/// Returns whether two orders of the same four vertices differ by an even permutation.
bool same_parity(const CellVertices& v, const CellVertices& w) {
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            inversions += (v[k] > v[i] ? 1 : 0) + (w[k] > w[i] ? 1 : 0);
        }
    }
    return inversions % 2 == 0;
}

/// Returns an upper bound of the error of (a + b) / 2 in binary64.
double rounding_of_half(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;  // two-sum: the rounding error of the sum, exactly
    const double lost = (a - (sum - b_part)) + (b - b_part);
    const double half = sum / 2;
    const double underflow = half + half == sum ? 0 : std::numeric_limits<double>::denorm_min();
    return std::abs(lost) / 2 + underflow;
}

/// Computed in long double, in which the square of no coordinate over- or underflows.
long double squared_distance(const Point& a, const Point& b) {
    const long double x = static_cast<long double>(a.x) - b.x;
    const long double y = static_cast<long double>(a.y) - b.y;
    const long double z = static_cast<long double>(a.z) - b.z;
    return x * x + y * y + z * z;
}

double rounding_of_midpoint(const Point& a, const Point& b) {
    return std::max(
        {rounding_of_half(a.x, b.x), rounding_of_half(a.y, b.y), rounding_of_half(a.z, b.z)});
}

/// Returns a sum of bounds, rounded up.
double sum_up(double a, double b) {
    const double sum = a + b;
    return a == 0 || b == 0 ? sum : std::nextafter(sum, std::numeric_limits<double>::infinity());
}

class DescentCheck {
public:
    DescentCheck(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines, Descent& descent,
                 Findings& findings)
        : coarse_(coarse), fine_(fine), lines_(lines), descent_(descent), findings_(findings) {
        const std::size_t cells = fine.mesh.cells.size();
        descent.parent.assign(cells, CellIndex::none());
        descent.face_of_parent.assign(cells, {-1, -1, -1, -1});
        descent.depth.assign(cells, 0);
        descent.halves.assign(fine.mesh.points.size(), {VertexIndex::none(), VertexIndex::none()});
        descent.rounding.assign(fine.mesh.points.size(), 0);
    }

    std::string run() {
        CellDivider divider(coarse_, fine_, lines_);
        std::vector<std::pair<CellIndex, CellVertices>> undivided;
        Steps step(findings_, coarse_.mesh.cells.size());
        for (CellIndex c{0}; c < coarse_.mesh.cells.end_index(); ++c) {
            step();
            CellVertices corners = coarse_.mesh.cells[c];
            for (VertexIndex& v : corners) v = descent_.coarse_to_fine[v];
            if (divider.divide_cell(corners)) {
                const bool own = owns(c);
                for (const Split& split : divider.splits()) take(split, own);
                for (const Leaf& leaf : divider.leaves()) take(leaf, c);
                if (own && divider.leaves().size() == 1) ++findings_.facts().cells_kept;
            } else {
                undivided.emplace_back(c, divider.undivided());
            }
        }
        for (const auto& [c, piece] : undivided) explain(c, piece);
        if (!any(findings_.group(), !undivided.empty())) report_orphans();
        return fmt::format("every cell by bisections from its parent, at most {}",
                           greatest(findings_.group(), findings_.facts().deepest));
    }

private:
    [[nodiscard]] bool owns(CellIndex coarse_cell) const {
        return coarse_.owns(coarse_.mesh.cells[coarse_cell]);
    }

    void take(const Split& split, bool own_cell) {
        EdgeVertices& halves = descent_.halves[split.midpoint];
        const bool is_new = descent_.is_coarse[split.midpoint.value()] == 0;
        if (is_new && halves[0].is_none()) {
            halves = split.edge;
            const double own = rounding_of_midpoint(fine_.mesh.points[split.edge[0]],
                                                    fine_.mesh.points[split.edge[1]]);
            const double inherited =
                std::max(descent_.rounding[split.edge[0]], descent_.rounding[split.edge[1]]);
            double& rounding = descent_.rounding[split.midpoint];
            rounding = sum_up(own, inherited);
            if (!fine_.owns(split.midpoint)) return;
            Facts& facts = findings_.facts();
            ++facts.bisected_edges;
            if (own > 0) ++facts.rounded_midpoints;
            facts.rounding_bound = std::max(facts.rounding_bound, rounding);
        } else if (!is_new || !is_half_way(split.midpoint, split.edge, descent_)) {
            if (own_cell) report_twice(split);
        }
    }

    void report_twice(const Split& split) {
        findings_.add(Code::not_a_midpoint, [&]() -> Findings::Description {
            return {{entity(split.midpoint), entity(split.edge)},
                    "a vertex that is already at another place of the coarse mesh",
                    "a vertex of its own for every midpoint"};
        });
    }

    void take(const Leaf& leaf, CellIndex parent) {
        const bool own = fine_.owns(fine_.mesh.cells[leaf.cell]);
        if (!descent_.parent[leaf.cell].is_none()) {
            if (!own) return;
            findings_.add(Code::not_tiled, [&]() -> Findings::Description {
                return {{entity(parent, Which::coarse), entity(leaf.cell)},
                        "a fine cell that also fills another coarse cell",
                        "fine cells of its own"};
            });
            return;
        }
        const bool same = same_parity(leaf.piece.vertices, fine_.mesh.cells[leaf.cell]);
        if (own && !same && fine_.sign[leaf.cell.value()] > 0) {
            findings_.add(Code::inverted_cell, [&]() -> Findings::Description {
                return {{entity(leaf.cell), entity(parent, Which::coarse)},
                        "positive only because its midpoints are rounded",
                        "the orientation of its parent"};
            });
        }
        descent_.parent[leaf.cell] = parent;
        descent_.depth[leaf.cell] = leaf.piece.depth;
        int& deepest = findings_.facts().deepest;
        if (own) deepest = std::max(deepest, static_cast<int>(leaf.piece.depth));
        const CellVertices& cell = fine_.mesh.cells[leaf.cell];
        for (std::size_t k = 0; k < 4; ++k) {
            const auto at = std::find(cell.begin(), cell.end(), leaf.piece.vertices[k]);
            descent_.face_of_parent[leaf.cell][static_cast<std::size_t>(at - cell.begin())] =
                leaf.piece.face_of_parent[k];
        }
    }

    /// Reports why a coarse cell cannot be divided: the last piece has an edge that needs a
    /// midpoint but only has a vertex close to it; otherwise the piece itself.
    void explain(CellIndex c, const CellVertices& undivided) {
        for (const auto& [i, j] : cell_edges) {
            const EdgeVertices edge{undivided[i], undivided[j]};
            if (lines_.is_line(edge[0], edge[1])) continue;
            const VertexIndex near = misplaced_vertex_near(edge);
            if (near.is_none()) continue;
            if (blamed_.empty()) blamed_.assign(fine_.mesh.points.size(), 0);
            if (blamed_[near.value()] != 0) return;  // already reported for another cell
            blamed_[near.value()] = 1;
            if (owns(c)) report_misplaced(near, edge);
            return;
        }
        if (!owns(c)) return;
        findings_.add(Code::not_tiled, [&]() -> Findings::Description {
            return {{entity(c, Which::coarse), entity(undivided)},
                    "no fine cells fill this piece of it",
                    "fine cells created from it by bisection"};
        });
    }

    void report_misplaced(VertexIndex v, const EdgeVertices& edge) {
        findings_.add(Code::not_a_midpoint, [&]() -> Findings::Description {
            const auto& points = fine_.mesh.points;
            return {{entity(v), entity(edge)},
                    "at " + shown(points[v]),
                    "half way, at " + shown(midpoint(points[edge[0]], points[edge[1]]))};
        });
    }

    /// Returns the vertex closest to the middle of an edge, but not equal to it, if it is not the
    /// midpoint of any two others and is within a quarter of the edge's length. Inspects all
    /// vertices; the number of searches is therefore limited.
    VertexIndex misplaced_vertex_near(const EdgeVertices& edge) {
        VertexIndex best = VertexIndex::none();
        if (searches_left_ == 0) return best;
        --searches_left_;
        const auto& points = fine_.mesh.points;
        const Point half = midpoint(points[edge[0]], points[edge[1]]);
        auto best_distance = squared_distance(points[edge[0]], points[edge[1]]) / 16;
        for (VertexIndex v{0}; v < points.end_index(); ++v) {
            if (points[v] == half) return VertexIndex::none();  // the error is a different one
            if (descent_.is_coarse[v.value()] != 0 || lines_.halves_a_line(v)) continue;
            const auto distance = squared_distance(points[v], half);
            if (distance >= best_distance) continue;
            best = v;
            best_distance = distance;
        }
        return best;
    }

    void report_orphans() {
        for (CellIndex c{0}; c < fine_.mesh.cells.end_index(); ++c) {
            if (!fine_.is_sound(c) || !descent_.parent[c].is_none()) continue;
            if (!fine_.owns(fine_.mesh.cells[c])) continue;
            findings_.add(Code::cell_of_no_parent, [&]() -> Findings::Description {
                return {{entity(c)}, "part of no coarse cell", "a parent"};
            });
        }
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    Lines& lines_;
    Descent& descent_;
    Findings& findings_;
    std::vector<char> blamed_;
    int searches_left_ = 1000;
};

}  // namespace

std::string check_descent(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                          Descent& descent, Findings& findings) {
    return DescentCheck(coarse, fine, lines, descent, findings).run();
}

}  // namespace octetra::verify
