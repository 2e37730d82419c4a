#include <fmt/format.h>

#include "mesh/checks.hpp"
#include "refinement/checks.hpp"

namespace octetra::verify {
namespace {

/// Returns, for each face of each coarse cell, by its tag, whether it is on the boundary.
std::vector<char> marked_boundary(const JudgedMesh& coarse) {
    std::vector<char> on_boundary(4 * coarse.mesh.cells.size(), 0);
    for (const CellFace f : boundary_faces(coarse)) on_boundary[tag_of(f)] = 1;
    return on_boundary;
}

}  // namespace

/// The descent assigns to every fine vertex a unique position, as a mean of coarse vertices, and
/// tiles each coarse cell with fine cells, the faces of which are assigned to coarse faces. Only
/// faces of a single cell remain to be checked. (Two fine cells meet correctly: if their common
/// face lay on two different coarse faces, or on one and in the interior of another cell, its three
/// vertices would be means of the one or two vertices that these have in common, and thus
/// collinear.)
std::string check_cover(const JudgedMesh& coarse, const JudgedMesh& fine, const Descent& descent,
                        Findings& findings) {
    const std::vector<char> on_boundary = marked_boundary(coarse);
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
