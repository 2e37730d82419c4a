#include <fmt/format.h>

#include "mesh/checks.hpp"
#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

/// Is each face of each coarse cell, by its tag, on the boundary?
std::vector<char> boundary_of(const JudgedMesh& coarse) {
    std::vector<char> on_boundary(4 * coarse.mesh.cells.size(), 0);
    for (const CellFace f : boundary_faces(coarse)) on_boundary[tag_of(f)] = 1;
    return on_boundary;
}

}  // namespace

/// Descent gives every fine vertex one place, as a mean of coarse vertices, and tiles each coarse
/// cell with fine cells, their faces known by the coarse face that they lie on. What is left to
/// check are faces of one cell. (Two fine cells can only meet rightly: if their common face lay on
/// two different coarse faces, or on one and inside another cell, its three vertices would be means
/// of the two vertices or the one that these have in common, on one line.)
std::string check_cover(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                        Findings& findings) {
    const std::vector<char> on_boundary = boundary_of(coarse);
    fine.faces.for_each_group([&](const FacetVertices& face, auto entries) {
        if (entries.size() != 1 || !fine.owns(face)) return;
        const CellFace f = cell_face(entries.front().tag);
        const auto whole = descent.coarse_face(f);
        if (whole && on_boundary[tag_of(*whole)] != 0) return;
        findings.add(Code::open_face, [&]() -> Findings::Description {
            return {{entity(face), entity(f.cell), entity(descent.parent[f.cell], Which::coarse)},
                    "one cell, and not on the boundary of the coarse mesh",
                    "a cell on each side"};
        });
    });
    const double bound = greatest(findings.group(), findings.facts().rounding_bound);
    return bound == 0
               ? "exactly: no midpoint was rounded"
               : fmt::format("up to rounding: no coordinate is off by more than {:.3g}", bound);
}

}  // namespace octetra::verify
