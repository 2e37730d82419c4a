#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/edge_order.hpp>

#include "mesh/face_edges.hpp"
#include "refinement/bisected_edges.hpp"
#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

/// Divides every coarse cell as regular refinement does, as far as its edges are bisected. A
/// process divides all those in its view, because cells that other processes own may have an edge
/// that it owns and must report.
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
            CellVertices corners = coarse_.mesh.cells[root_];
            for (VertexIndex& v : corners) v = descent_.coarse_to_fine[v];
            visit(corners, 0);
        }
        const int most = greatest(findings_.group(), generations_);
        return fmt::format("regular cells of {} generation{}, and transition cells that are whole",
                           most, most == 1 ? "" : "s");
    }

private:
    [[nodiscard]] static EdgeVertices ends(const CellVertices& cell, std::size_t e) {
        const auto& [low, high] = std::minmax(cell[cell_edges[e][0]], cell[cell_edges[e][1]]);
        return {low, high};
    }

    [[nodiscard]] bool is_longer(const EdgeVertices& e, const EdgeVertices& f) const {
        const auto& p = fine_.mesh.points;
        return longer({p[e[0]], p[e[1]]}, {p[f[0]], p[f[1]]});
    }

    [[nodiscard]] bool is_fine_cell(const CellVertices& vertices) {
        return !finder_.find(vertices).is_none();
    }

    void visit(const CellVertices& vertices, int generation) {
        generations_ = std::max(generations_, generation);
        if (is_fine_cell(vertices)) return;
        BisectedEdges bisected(fine_.mesh.points);
        for (std::size_t e = 0; e < 6; ++e) {
            const EdgeVertices edge = ends(vertices, e);
            if (!lines_.is_bisected(edge)) continue;
            bisected.add({edge, lines_.midpoint(edge[0], edge[1])});
        }
        if (!is_closed(vertices)) return;
        bisected.for_each_piece(vertices, [&](const CellVertices& child) {
            if (bisected.size() == 6) {
                visit(child, generation + 1);
            } else if (!is_fine_cell(child)) {
                report_child(child);
            }
        });
    }

    /// Returns whether the longest edge of each face with a bisected edge is bisected.
    bool is_closed(const CellVertices& cell) {
        bool is_closed = true;
        for (const auto& face : face_edges) {
            EdgeVertices longest = ends(cell, face[0]);
            bool has_bisected = false;
            for (const std::size_t e : face) {
                const EdgeVertices edge = ends(cell, e);
                if (is_longer(edge, longest)) longest = edge;
                has_bisected = has_bisected || lines_.is_bisected(edge);
            }
            if (!has_bisected || lines_.is_bisected(longest)) continue;
            is_closed = false;
            if (std::exchange(reported_.at(longest[0], longest[1]), 1U) == 1U) continue;
            if (!fine_.owns(longest)) continue;
            findings_.add(Code::missing_bisection, [&]() -> Findings::Description {
                return {{entity(longest)},
                        "not bisected",
                        "bisected, as the longest edge of a face with a bisected edge"};
            });
        }
        return is_closed;
    }

    void report_child(const CellVertices& child) {
        if (!coarse_.owns(coarse_.mesh.cells[root_])) return;
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
