#include "exact/predicates.hpp"
#include "subject.hpp"

namespace octetra::verify {

std::string check_orientation(Subject& subject, Findings& findings) {
    const Mesh& mesh = subject.mesh;
    subject.sign.assign(mesh.cells.size(), 0);
    Steps step(findings, mesh.cells.size());
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        step();
        if (!subject.is_sound(c)) continue;
        const auto [p, q, r, s] = subject.corners(c);
        const int sign = exact::orientation(p, q, r, s, findings.arithmetic());
        subject.sign[c.value()] = static_cast<std::int8_t>(sign);
        if (sign > 0 || !subject.owns(mesh.cells[c])) continue;
        findings.add(sign < 0 ? Code::inverted_cell : Code::flat_cell,
                     [&]() -> Findings::Description {
                         return {{entity(c, subject.which)},
                                 sign < 0 ? "a negative volume" : "no volume",
                                 "a positive volume"};
                     });
    }
    return {};
}

}  // namespace octetra::verify
