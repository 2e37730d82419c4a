#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 4> face_edges{
    {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};  // positions in cell_edges

/// Divides every coarse cell as regular refinement does, as far as its edges are bisected.
class RegularCheck {
public:
    RegularCheck(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                 const Descent& descent, Findings& findings)
        : coarse_(coarse),
          fine_(fine),
          lines_(lines),
          descent_(descent),
          findings_(findings),
          finder_(fine) {}

    std::string run() {
        Steps step(findings_, coarse_.mesh.cells.size());
        for (root_ = CellIndex{0}; root_ < coarse_.mesh.cells.end_index(); ++root_) {
            step();
            if (!coarse_.owns(coarse_.mesh.cells[root_])) continue;
            CellVertices corners = coarse_.mesh.cells[root_];
            for (VertexIndex& v : corners) v = descent_.coarse_to_fine[v];
            visit(corners, 0);
        }
        const int most = greatest(findings_.group(), generations_);
        return fmt::format("regular cells of {} generation{}, and transition cells that are whole",
                           most, most == 1 ? "" : "s");
    }

private:
    /// A regular cell with its edges in the order of cell_edges.
    struct RegularCell {
        CellVertices vertices;
        std::array<VertexIndex, 6> midpoints;  ///< none() for edges that are not bisected
        std::array<std::size_t, 6> longest_first{0, 1, 2, 3, 4, 5};

        [[nodiscard]] EdgeVertices ends(std::size_t e) const {
            return {vertices[cell_edges[e][0]], vertices[cell_edges[e][1]]};
        }
    };

    [[nodiscard]] Segment segment(const EdgeVertices& edge) const {
        return {fine_.mesh.points[edge[0]], fine_.mesh.points[edge[1]]};
    }

    [[nodiscard]] bool is_longer(const RegularCell& cell, std::size_t e, std::size_t f) const {
        return longer(segment(cell.ends(e)), segment(cell.ends(f)));
    }

    [[nodiscard]] bool is_fine_cell(const CellVertices& vertices) {
        return !finder_.find(vertices).is_none();
    }

    void visit(const CellVertices& vertices, int generation) {
        generations_ = std::max(generations_, generation);
        if (is_fine_cell(vertices)) return;
        RegularCell cell{vertices, {}};
        std::size_t bisected = 0;
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [a, b] = cell.ends(e);
            if (!lines_.is_whole(a, b)) cell.midpoints[e] = lines_.midpoint(a, b);
            bisected += cell.midpoints[e].is_none() ? 0U : 1U;
        }
        // Insertion sort: the order is strict, and there are only six.
        auto& order = cell.longest_first;
        for (std::size_t i = 1; i < 6; ++i) {
            for (std::size_t k = i; k > 0 && is_longer(cell, order[k], order[k - 1]); --k) {
                std::swap(order[k], order[k - 1]);
            }
        }
        if (!is_closed(cell)) return;
        std::vector<CellVertices> children;
        bisect(cell, vertices, children);
        for (const CellVertices& child : children) {
            if (bisected == 6) {
                visit(child, generation + 1);
            } else if (!is_fine_cell(child)) {
                report_child(child);
            }
        }
    }

    /// Returns whether the longest edge of each face with a bisected edge is bisected.
    bool is_closed(const RegularCell& cell) {
        bool is_closed = true;
        for (const auto& face : face_edges) {
            const auto is_bisected = [&](std::size_t e) { return !cell.midpoints[e].is_none(); };
            if (std::ranges::none_of(face, is_bisected)) continue;
            std::size_t longest = face[0];
            for (const std::size_t e : face) longest = is_longer(cell, e, longest) ? e : longest;
            if (is_bisected(longest)) continue;
            is_closed = false;
            const EdgeVertices edge = cell.ends(longest);
            if (std::exchange(reported_.at(edge[0], edge[1]), 1U) == 1U) continue;
            findings_.add(Code::missing_bisection, [&]() -> Findings::Description {
                return {{entity(edge)},
                        "not bisected",
                        "bisected, as the longest edge of a face with a bisected edge"};
            });
        }
        return is_closed;
    }

    /// Appends the children of a piece of the cell.
    static void bisect(const RegularCell& cell, const CellVertices& piece,
                       std::vector<CellVertices>& children) {
        for (const std::size_t e : cell.longest_first) {
            if (cell.midpoints[e].is_none()) continue;
            const EdgeVertices ends = cell.ends(e);
            const auto first = std::ranges::find(piece, ends[0]);
            const auto second = std::ranges::find(piece, ends[1]);
            if (first == piece.end() || second == piece.end()) continue;
            for (const auto leaving : {first, second}) {
                CellVertices half = piece;
                half[static_cast<std::size_t>(leaving - piece.begin())] = cell.midpoints[e];
                bisect(cell, half, children);
            }
            return;
        }
        children.push_back(piece);
    }

    void report_child(const CellVertices& child) {
        findings_.add(Code::bisected_transition_cell, [&]() -> Findings::Description {
            return {{entity(child), entity(root_, Which::coarse)},
                    "a transition cell that is bisected",
                    "eight regular cells in place of its family"};
        });
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    Lines& lines_;
    const Descent& descent_;
    Findings& findings_;
    CellFinder finder_;       ///< of the fine mesh
    EdgeTable reported_{16};  ///< edges that are not bisected
    CellIndex root_;
    int generations_ = 0;
};

}  // namespace

std::string check_regular_closure(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines,
                                  const Descent& descent, Findings& findings) {
    return RegularCheck(coarse, fine, lines, descent, findings).run();
}

}  // namespace octetra::verify
