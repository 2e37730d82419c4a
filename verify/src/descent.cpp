#include "descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

namespace octetra::verify {
namespace {

std::string shown(const Point& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

/// Part of a coarse cell.
struct Piece {
    CellVertices vertices;
    std::array<std::int8_t, 4> face_of_parent{0, 1, 2, 3};
    std::uint8_t depth = 0;
};

struct Leaf {
    CellIndex cell;
    Piece piece;
};

/// A vertex put between two others.
struct Split {
    EdgeVertices edge;
    VertexIndex midpoint;
};

/// Divides one coarse cell after the other.
///
/// A piece that is no fine cell was bisected at one of its edges, a b, and then the midpoint m has
/// lines to the other two corners; or it was cut into eight at all six. Mostly one way fits; where
/// several do, they are tried, longest edge first, until one leads to fine cells all over.
class Divider {
public:
    Divider(const Subject& coarse, const Subject& fine, Lines& lines)
        : fine_(&fine), lines_(&lines) {
        // A mesh that is right needs two pieces for each fine cell, and some to take back.
        const std::size_t cells = coarse.mesh.cells.size() + fine.mesh.cells.size();
        budget_ = 100'000 + 20 * static_cast<std::int64_t>(cells);
    }

    /// Finds the fine cells that fill a coarse cell. False if there is no way.
    bool divide_cell(const CellVertices& vertices) {
        leaves_.clear();
        splits_.clear();
        stuck_ = {};
        stuck_leaves_ = 0;
        return divide({vertices});
    }

    [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
    [[nodiscard]] const std::vector<Split>& splits() const { return splits_; }
    /// A piece that could not be divided, when the most others could.
    [[nodiscard]] const CellVertices& stuck() const { return stuck_; }

private:
    bool divide(const Piece& piece) {
        const auto found = fine_->cells.find(piece.vertices);
        if (!found.empty()) {
            leaves_.push_back({CellIndex{found.front().tag}, piece});
            return true;
        }
        if (piece.depth < most_depth && budget_-- > 0) {
            if (bisect(piece) || cut_into_eight(piece)) return true;
        }
        if (stuck_leaves_ == 0 || leaves_.size() + 1 > stuck_leaves_) {
            stuck_ = piece.vertices;
            stuck_leaves_ = leaves_.size() + 1;
        }
        return false;
    }

    /// Tries a way of dividing; takes back what it has found if it leads nowhere.
    bool attempt(auto&& pieces) {
        const std::size_t leaves = leaves_.size();
        const std::size_t splits = splits_.size();
        if (std::all_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return divide(p); })) {
            return true;
        }
        leaves_.resize(leaves);
        splits_.resize(splits);
        return false;
    }

    struct Choice {
        std::size_t edge = 0;
        VertexIndex midpoint;
    };

    bool bisect(const Piece& piece) {
        const CellVertices& v = piece.vertices;
        std::array<Choice, 6> choices;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 6; ++k) {
            const auto [i, j] = cell_edges[k];
            const VertexIndex m = lines_->midpoint(v[i], v[j]);
            if (m.is_none()) continue;
            const auto [c, d] = cell_edges[5 - k];  // the opposite edge
            if (lines_->is_line(m, v[c]) && lines_->is_line(m, v[d])) choices[count++] = {k, m};
        }
        for (std::size_t n = 0; n < count; ++n) {
            take_longest_first(piece, choices, n, count);
            const auto [i, j] = cell_edges[choices[n].edge];
            splits_.push_back({{v[i], v[j]}, choices[n].midpoint});
            if (attempt(halves(piece, i, j, choices[n].midpoint))) return true;
            splits_.pop_back();
        }
        return false;
    }

    /// Puts the longest of choices[n ...] at n.
    void take_longest_first(const Piece& piece, std::array<Choice, 6>& choices, std::size_t n,
                            std::size_t count) const {
        const auto segment = [&](const Choice& choice) {
            const auto [i, j] = cell_edges[choice.edge];
            return Segment{fine_->mesh.points[piece.vertices[i]],
                           fine_->mesh.points[piece.vertices[j]]};
        };
        for (std::size_t k = n + 1; k < count; ++k) {
            if (longer(segment(choices[k]), segment(choices[n]))) {
                std::swap(choices[k], choices[n]);
            }
        }
    }

    static std::array<Piece, 2> halves(const Piece& piece, std::size_t i, std::size_t j,
                                       VertexIndex m) {
        Piece first = piece;  // keeps corner i
        first.vertices[j] = m;
        first.face_of_parent[i] = -1;
        Piece second = piece;
        second.vertices[i] = m;
        second.face_of_parent[j] = -1;
        first.depth = second.depth = static_cast<std::uint8_t>(piece.depth + 1);
        return {first, second};
    }

    bool cut_into_eight(const Piece& piece) {
        const CellVertices& v = piece.vertices;
        std::array<VertexIndex, 6> m;
        for (std::size_t k = 0; k < 6; ++k) {
            const auto [i, j] = cell_edges[k];
            m[k] = lines_->midpoint(v[i], v[j]);
            if (m[k].is_none()) return false;
        }
        const std::size_t splits = splits_.size();
        for (std::size_t k = 0; k < 6; ++k) {
            const auto [i, j] = cell_edges[k];
            splits_.push_back({{v[i], v[j]}, m[k]});
        }
        for (std::size_t diagonal = 0; diagonal < 3; ++diagonal) {
            if (!lines_->is_line(m[diagonal], m[5 - diagonal])) continue;
            if (attempt(eight_pieces(piece, m, diagonal))) return true;
        }
        splits_.resize(splits);
        return false;
    }

    /// The number of the edge between two corners, in cell_edges.
    static constexpr std::size_t edge_of(std::size_t i, std::size_t j) {
        constexpr std::array<std::array<std::size_t, 4>, 4> numbers{
            {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
        return numbers[i][j];
    }

    /// Four corners, and four cells round one diagonal of the octahedron between them.
    static std::array<Piece, 8> eight_pieces(const Piece& piece,
                                             const std::array<VertexIndex, 6>& m,
                                             std::size_t diagonal) {
        const auto depth = static_cast<std::uint8_t>(piece.depth + 3);
        std::array<Piece, 8> pieces;
        for (std::size_t corner = 0; corner < 4; ++corner) {
            Piece& p = pieces[corner] = piece;
            p.depth = depth;
            for (std::size_t k = 0; k < 4; ++k) {
                if (k != corner) p.vertices[k] = m[edge_of(corner, k)];
            }
            p.face_of_parent[corner] = -1;
        }
        // Diagonal k joins the midpoints of edge a b and of the opposite one, c d. Round it lie the
        // midpoints of a c, b c, b d, a d, in this order; each two next to each other have a corner
        // of the cell in common, and with it they and one end of the diagonal lie on a face.
        const auto [a, b] = cell_edges[diagonal];
        const auto [c, d] = cell_edges[5 - diagonal];
        const std::array<std::array<std::size_t, 2>, 4> round{{{a, c}, {b, c}, {b, d}, {a, d}}};
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& near = round[k];
            const auto& far = round[(k + 1) % 4];
            const VertexIndex p = m[edge_of(near[0], near[1])];
            const VertexIndex q = m[edge_of(far[0], far[1])];
            // They share c: midpoints of ac and bc, with that of ab, lie on face abc, without d;
            // they share b: midpoints of bc and bd, with that of cd, lie on face bcd, without a.
            const bool share_end_of_second = near[1] == far[1];
            const std::size_t shared = share_end_of_second ? near[1] : near[0];
            const std::size_t missing =
                share_end_of_second ? (shared == c ? d : c) : (shared == a ? b : a);
            Piece& piece_k = pieces[4 + k];
            piece_k.depth = depth;
            piece_k.vertices = {m[diagonal], m[5 - diagonal], p, q};
            piece_k.face_of_parent = {-1, -1, -1, -1};
            // The face has the end of the diagonal on ab (or cd), so the other end is opposite.
            piece_k.face_of_parent[share_end_of_second ? 1 : 0] = piece.face_of_parent[missing];
            // They run round the diagonal the wrong way if a, b, c, d is an even order.
            if (diagonal != 1) std::swap(piece_k.vertices[2], piece_k.vertices[3]);
        }
        return pieces;
    }

    static constexpr std::uint8_t most_depth = 240;

    const Subject* fine_;
    Lines* lines_;
    std::vector<Leaf> leaves_;
    std::vector<Split> splits_;
    std::int64_t budget_ = 0;  ///< how many more pieces may be divided: a wrong mesh has many ways
    CellVertices stuck_;
    std::size_t stuck_leaves_ = 0;
};

/// Do two orders of the same four vertices differ by an even permutation?
bool same_parity(const CellVertices& v, const CellVertices& w) {
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            inversions += (v[k] > v[i] ? 1 : 0) + (w[k] > w[i] ? 1 : 0);
        }
    }
    return inversions % 2 == 0;
}

/// By how much (a + b) / 2 is off, at most, as binary64 rounds it.
double rounding_of_half(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;  // two-sum: what is lost in the sum, exactly
    const double lost = (a - (sum - b_part)) + (b - b_part);
    const double half = sum / 2;
    const double underflow = half + half == sum ? 0 : std::numeric_limits<double>::denorm_min();
    return std::abs(lost) / 2 + underflow;
}

/// In numbers of which no coordinate's square is too large or too small.
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

/// A sum of bounds, rounded up.
double sum_up(double a, double b) {
    const double sum = a + b;
    return a == 0 || b == 0 ? sum : std::nextafter(sum, std::numeric_limits<double>::infinity());
}

/// How a vertex is made of those of the coarse mesh: their weights, each a power of two's share.
using Weights = std::map<VertexIndex, double>;

/// Weights are sums of powers of 2^-depth: exact in binary64 to a depth of fifty.
void add_weights(VertexIndex v, double weight, const Descent& descent, Weights& weights) {
    const EdgeVertices& ends = descent.halves[v];
    if (ends[0].is_none()) {
        weights[v] += weight;
        return;
    }
    for (const VertexIndex end : ends) add_weights(end, weight / 2, descent, weights);
}

class DescentCheck {
public:
    DescentCheck(const Subject& coarse, const Subject& fine, Lines& lines, Descent& descent,
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
        Divider divider(coarse_, fine_, lines_);
        std::vector<std::pair<CellIndex, CellVertices>> stuck;
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
                stuck.emplace_back(c, divider.stuck());
            }
        }
        for (const auto& [c, piece] : stuck) explain(c, piece);
        if (!any(findings_.group(), !stuck.empty())) report_orphans();
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

    /// Why a coarse cell cannot be divided: the piece where it ends has an edge that should have a
    /// vertex half way, and has one only near there; or else that piece itself.
    void explain(CellIndex c, const CellVertices& stuck) {
        for (const auto& [i, j] : cell_edges) {
            const EdgeVertices edge{stuck[i], stuck[j]};
            if (lines_.is_line(edge[0], edge[1])) continue;
            const VertexIndex near = misplaced_vertex_near(edge);
            if (near.is_none()) continue;
            if (blamed_.empty()) blamed_.assign(fine_.mesh.points.size(), 0);
            if (blamed_[near.value()] != 0) return;  // for another cell, which has told
            blamed_[near.value()] = 1;
            if (owns(c)) report_misplaced(near, edge);
            return;
        }
        if (!owns(c)) return;
        findings_.add(Code::not_tiled, [&]() -> Findings::Description {
            return {{entity(c, Which::coarse), entity(stuck)},
                    "no fine cells fill this piece of it",
                    "fine cells that come of it by bisection"};
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

    /// The vertex that is nearest to the middle of an edge, but not there, if it is half way
    /// between no two others and within a quarter of the edge's length. Looks at all vertices, so
    /// not too often.
    VertexIndex misplaced_vertex_near(const EdgeVertices& edge) {
        VertexIndex best = VertexIndex::none();
        if (searches_left_ == 0) return best;
        --searches_left_;
        const auto& points = fine_.mesh.points;
        const Point half = midpoint(points[edge[0]], points[edge[1]]);
        auto best_distance = squared_distance(points[edge[0]], points[edge[1]]) / 16;
        for (VertexIndex v{0}; v < points.end_index(); ++v) {
            if (points[v] == half) return VertexIndex::none();  // what is wrong is something else
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

    const Subject& coarse_;
    const Subject& fine_;
    Lines& lines_;
    Descent& descent_;
    Findings& findings_;
    std::vector<char> blamed_;
    int searches_left_ = 1000;
};

}  // namespace

namespace {

/// The vertex of the fine mesh with the number that v has in the coarse one; none() if there is
/// none here.
VertexIndex of_same_number(VertexIndex v, const Findings& findings) {
    return findings.numbers(Which::fine)
        .vertices.find(findings.numbers(Which::coarse).vertices.of(v.value()));
}

/// Collective. Are the vertices of the coarse mesh the first ones of the fine mesh, in its order?
bool are_first_vertices(const Subject& coarse, const Subject& fine, const Findings& findings) {
    bool differ = false;
    for (VertexIndex v{0}; v < coarse.mesh.points.end_index() && !differ; ++v) {
        if (!coarse.owns(v)) continue;
        const VertexIndex w = of_same_number(v, findings);
        differ =
            !(w < fine.mesh.points.end_index()) || fine.mesh.points[w] != coarse.mesh.points[v];
    }
    return !any(findings.group(), differ);
}

}  // namespace

std::string find_coarse_vertices(const Subject& coarse, const Subject& fine, const Places& places,
                                 Descent& descent, Findings& findings) {
    const auto& coarse_points = coarse.mesh.points;
    const auto& fine_points = fine.mesh.points;
    const bool same_numbers = are_first_vertices(coarse, fine, findings);

    std::vector<char> used(coarse_points.size(), 0);
    for (const CellVertices& cell : coarse.mesh.cells) {
        for (const VertexIndex v : cell) used[v.value()] = 1;
    }
    descent.is_coarse.assign(fine_points.size(), 0);
    descent.coarse_to_fine.assign(coarse_points.size(), VertexIndex::none());
    for (VertexIndex v{0}; v < coarse_points.end_index(); ++v) {
        VertexIndex& found = descent.coarse_to_fine[v];
        const auto is_free = [&](VertexIndex w) { return descent.is_coarse[w.value()] == 0; };
        found = same_numbers ? of_same_number(v, findings) : places.find(coarse_points[v], is_free);
        if (!found.is_none()) {
            descent.is_coarse[found.value()] = 1;
        } else if (used[v.value()] != 0 && coarse.owns(v)) {
            findings.add(Code::lost_vertex, [&]() -> Findings::Description {
                return {{entity(v, Which::coarse)},
                        "no vertex at " + shown(coarse_points[v]),
                        "every vertex of the coarse mesh"};
            });
        }
    }
    return same_numbers ? "by number" : "by place";
}

std::string check_descent(const Subject& coarse, const Subject& fine, Lines& lines,
                          Descent& descent, Findings& findings) {
    return DescentCheck(coarse, fine, lines, descent, findings).run();
}

bool is_half_way(VertexIndex m, const EdgeVertices& edge, const Descent& descent) {
    const EdgeVertices& known = descent.halves[m];
    if (known == edge || known == EdgeVertices{edge[1], edge[0]}) return true;
    Weights of_midpoint;
    Weights of_edge;
    add_weights(m, 1, descent, of_midpoint);
    for (const VertexIndex end : edge) add_weights(end, 0.5, descent, of_edge);
    return of_midpoint == of_edge;
}

}  // namespace octetra::verify
