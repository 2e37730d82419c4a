#include <fmt/format.h>

#include "mesh/checks.hpp"

namespace octetra::verify {
namespace {

/// Returns whether the cell, which is positive, lies on the side of the face towards which the
/// ascending order of its vertices is oriented.
bool is_on_even_side(const JudgedMesh& judged, CellFace f) {
    return is_even(outward_face(judged.mesh.cells[f.cell], f.face));
}

}  // namespace

std::string check_faces(const JudgedMesh& judged, Findings& findings) {
    Facts& facts = findings.facts();
    for (VertexIndex v{0}; v < judged.mesh.points.end_index(); ++v) {
        if (judged.owns(v)) ++facts.vertices;
    }
    for (const CellVertices& cell : judged.mesh.cells) {
        if (judged.owns(cell)) ++facts.cells;
    }
    judged.edges.for_each([&](const EdgeVertices& edge) {
        if (judged.owns(edge)) ++facts.edges;
    });
    judged.faces.for_each_group([&](const FacetVertices& vertices, auto entries) {
        if (!judged.owns(vertices)) return;
        ++facts.faces;
        if (entries.size() == 1) {
            ++facts.boundary_faces;
            return;
        }
        const auto describe = [&](std::string found, std::string expected) {
            Findings::Description description{
                {entity(vertices, judged.which)}, std::move(found), std::move(expected)};
            for (const auto& entry : entries) {
                description.entities.push_back(entity(cell_face(entry.tag).cell, judged.which));
            }
            return description;
        };
        if (entries.size() > 2) {
            findings.add(Code::face_of_many_cells, [&] {
                return describe(fmt::format("{} cells", entries.size()), "one or two");
            });
            return;
        }
        const CellFace first = cell_face(entries[0].tag);
        const CellFace second = cell_face(entries[1].tag);
        const bool positive =
            judged.sign[first.cell.value()] > 0 && judged.sign[second.cell.value()] > 0;
        // (Cells that are not positive are reported elsewhere.)
        if (positive && is_on_even_side(judged, first) == is_on_even_side(judged, second)) {
            findings.add(Code::cells_on_one_side, [&] {
                return describe("both cells on one side", "one cell on each side");
            });
        }
    });
    return {};
}

std::vector<CellFace> boundary_faces(const JudgedMesh& judged) {
    std::vector<CellFace> faces;
    judged.faces.for_each_group([&](const FacetVertices&, auto entries) {
        if (entries.size() == 1) faces.push_back(cell_face(entries[0].tag));
    });
    return faces;
}

}  // namespace octetra::verify
