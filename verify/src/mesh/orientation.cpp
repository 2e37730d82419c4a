#include "exact/predicates.hpp"
#include "mesh/checks.hpp"

namespace octetra::verify {

std::string check_orientation(JudgedMesh& judged, Findings& findings) {
    const Mesh& mesh = judged.mesh;
    judged.sign.assign(mesh.cells.size(), 0);
    Steps step(findings, mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        step();
        if (!judged.is_sound(c)) continue;
        const auto [p, q, r, s] = judged.corners(c);
        const int sign = exact::orientation(p, q, r, s, findings.arithmetic());
        judged.sign[c.value()] = static_cast<std::int8_t>(sign);
        if (sign > 0 || !judged.owns(mesh.cells[c])) continue;
        findings.add(sign < 0 ? Code::inverted_cell : Code::flat_cell,
                     [&]() -> Findings::Description {
                         return {{entity(c, judged.which)},
                                 sign < 0 ? "a negative volume" : "no volume",
                                 "a positive volume"};
                     });
    }
    return {};
}

}  // namespace octetra::verify
