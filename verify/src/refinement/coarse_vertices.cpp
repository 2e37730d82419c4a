#include <algorithm>
#include <array>
#include <map>

#include <octetra/core/selection.hpp>

#include "exact/predicates.hpp"
#include "refinement/descent.hpp"

namespace octetra::verify {
namespace {

/// Returns the vertex of the fine mesh with the same number as v has in the coarse one, or none()
/// if it is not in this part.
VertexIndex of_same_number(VertexIndex v, const Findings& findings) {
    return findings.numbers(Which::fine)
        .vertices.find(findings.numbers(Which::coarse).vertices.of(v.value()));
}

/// Collective. Returns whether the first vertices of the fine mesh are those of the coarse mesh, in
/// order.
bool are_first_vertices(const JudgedMesh& coarse, const JudgedMesh& fine,
                        const Findings& findings) {
    bool differ = false;
    for (VertexIndex v{0}; v < coarse.mesh.points.end_index() && !differ; ++v) {
        if (!coarse.owns(v)) continue;
        const VertexIndex w = of_same_number(v, findings);
        differ =
            !(w < fine.mesh.points.end_index()) || fine.mesh.points[w] != coarse.mesh.points[v];
    }
    return !any(findings.group(), differ);
}

/// Matches coincident vertices, as at a crack: a coarse vertex corresponds to the fine vertex whose
/// cells lie in cells of the coarse vertex. A wrong choice, possible for cells so thin that a
/// rounded centroid lies outside, can make the descent fail, but never pass.
class SidesOfCracks {
public:
    SidesOfCracks(const JudgedMesh& coarse, const JudgedMesh& fine, const PointLookup& places,
                  Findings& findings)
        : coarse_(coarse),
          fine_(fine),
          places_(places),
          findings_(findings),
          cell_at_(coarse.mesh.points.size(), CellIndex::none()) {
        find_coincident_points();
        if (fine_cells_at_.empty()) return;
        const auto take_fine = [&](VertexIndex w, CellIndex c) {
            if (const auto at = fine_cells_at_.find(w); at != fine_cells_at_.end()) {
                at->second.push_back(c);
            }
        };
        for_each_corner(fine_, take_fine);
        for_each_corner(coarse_, [&](VertexIndex v, CellIndex c) {
            if (cell_at_[v].is_none()) cell_at_[v] = c;
        });
    }

    /// Returns the free fine vertex with the coordinates of v whose cells lie in a cell of v;
    /// none() if there is none, or if no vertices coincide there.
    [[nodiscard]] VertexIndex find(VertexIndex v, auto&& is_free) {
        const CellIndex c = cell_at_[v];
        if (c.is_none()) return VertexIndex::none();
        const CellVertices& cell = coarse_.mesh.cells[c];
        const auto corner = std::find(cell.begin(), cell.end(), v) - cell.begin();
        return places_.find(coarse_.mesh.points[v], [&](VertexIndex w) {
            const auto cells = fine_cells_at_.find(w);
            if (cells == fine_cells_at_.end() || !is_free(w)) return false;
            const auto is_inside = [&](CellIndex f) {
                return lies_inside(f, c, static_cast<std::size_t>(corner));
            };
            return std::any_of(cells->second.begin(), cells->second.end(), is_inside);
        });
    }

private:
    void find_coincident_points() {
        for (const Point& p : coarse_.mesh.points) {
            std::vector<VertexIndex> there;
            (void)places_.find(p, [&](VertexIndex w) {
                there.push_back(w);
                return false;
            });
            if (there.size() < 2) continue;
            for (const VertexIndex w : there) fine_cells_at_[w];
        }
    }

    static void for_each_corner(const JudgedMesh& judged, auto&& visit) {
        for (CellIndex c{0}; c < judged.mesh.cells.end_index(); ++c) {
            if (judged.sign[c.value()] <= 0) continue;
            for (const VertexIndex v : judged.mesh.cells[c]) visit(v, c);
        }
    }

    /// Returns whether the centroid of a fine cell is on the inner side of the three faces at a
    /// coarse corner.
    [[nodiscard]] bool lies_inside(CellIndex fine_cell, CellIndex coarse_cell, std::size_t corner) {
        const Point centre = centroid(fine_.corners(fine_cell));
        for (std::size_t k = 0; k < 4; ++k) {
            if (k == corner) continue;
            auto [a, b, c, d] = coarse_.corners(coarse_cell);
            *std::array{&a, &b, &c, &d}[k] = centre;
            if (exact::orientation(a, b, c, d, findings_.arithmetic()) <= 0) return false;
        }
        return true;
    }

    const JudgedMesh& coarse_;
    const JudgedMesh& fine_;
    const PointLookup& places_;
    Findings& findings_;
    IndexVector<VertexIndex, CellIndex> cell_at_;  ///< a cell of each coarse vertex
    /// The cells at each fine vertex that coincides with other vertices.
    std::map<VertexIndex, std::vector<CellIndex>> fine_cells_at_;
};

}  // namespace

std::string find_coarse_vertices(const JudgedMesh& coarse, const JudgedMesh& fine,
                                 const PointLookup& places, Descent& descent, Findings& findings) {
    const auto& coarse_points = coarse.mesh.points;
    const auto& fine_points = fine.mesh.points;
    const bool same_numbers = are_first_vertices(coarse, fine, findings);

    const std::vector<char> used = used_vertices(coarse.mesh);
    descent.is_coarse.assign(fine_points.size(), 0);
    descent.coarse_to_fine.assign(coarse_points.size(), VertexIndex::none());
    const auto is_free = [&](VertexIndex w) { return descent.is_coarse[w.value()] == 0; };
    if (!same_numbers) {
        SidesOfCracks sides(coarse, fine, places, findings);
        for (VertexIndex v{0}; v < coarse_points.end_index(); ++v) {
            const VertexIndex found = sides.find(v, is_free);
            descent.coarse_to_fine[v] = found;
            if (!found.is_none()) descent.is_coarse[found.value()] = 1;
        }
    }
    for (VertexIndex v{0}; v < coarse_points.end_index(); ++v) {
        VertexIndex& found = descent.coarse_to_fine[v];
        if (same_numbers) {
            found = of_same_number(v, findings);
        } else if (found.is_none()) {
            found = places.find(coarse_points[v], is_free);
        }
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

}  // namespace octetra::verify
