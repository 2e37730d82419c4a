#include "refinement/descent.hpp"

namespace octetra::verify {
namespace {

/// The vertex of the fine mesh with the number that v has in the coarse one; none() if there is
/// none here.
VertexIndex of_same_number(VertexIndex v, const Findings& findings) {
    return findings.numbers(Which::fine)
        .vertices.find(findings.numbers(Which::coarse).vertices.of(v.value()));
}

/// Collective. Are the vertices of the coarse mesh the first ones of the fine mesh, in its order?
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

}  // namespace

std::string find_coarse_vertices(const JudgedMesh& coarse, const JudgedMesh& fine,
                                 const Places& places, Descent& descent, Findings& findings) {
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

}  // namespace octetra::verify
