#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <octetra/core/maps.hpp>
#include <octetra/verify/verify.hpp>

#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/bits.hpp"
#include "support/refinement.hpp"
#include "verify/verdicts.hpp"

namespace octetra::properties {
namespace {

/// Returns whether a + b, and therefore its half, is not representable.
bool is_rounded(double a, double b) {
    const double sum = a + b;
    const double of_b = sum - a;
    return (a - (sum - of_b)) + (b - of_b) != 0;
}

bool is_rounded(const Point& a, const Point& b) {
    return is_rounded(a.x, b.x) || is_rounded(a.y, b.y) || is_rounded(a.z, b.z);
}

/// Returns, for each vertex, whether rounding moved it.
std::vector<char> moved_by_rounding(const Mesh& fine, const RefinementMaps& maps) {
    std::vector<char> moved(fine.points.size(), 0);
    for (std::size_t k = 0; k < maps.midpoint_to_edge.size(); ++k) {
        const auto& [a, b] = maps.midpoint_to_edge[k];
        moved[maps.first_midpoint.value() + k] = moved[a.value()] != 0 || moved[b.value()] != 0 ||
                                                 is_rounded(fine.points[a], fine.points[b]);
    }
    return moved;
}

/// A rounded midpoint may lie on or in another cell if cells without a common face are as close as
/// the spacing of floating-point numbers. The engines do not check this; the verifier
/// reports it. A cell that has the whole edge must have been cut there.
bool may_meet_by_rounding(const Mesh& fine, const RefinementMaps& maps,
                          const std::vector<verify::Violation>& violations) {
    const std::vector<char> moved = moved_by_rounding(fine, maps);
    return std::ranges::all_of(violations, [&](const verify::Violation& violation) {
        if (violation.code != verify::Code::hanging_vertex &&
            violation.code != verify::Code::vertex_in_cell) {
            return false;
        }
        const std::uint32_t vertex = violation.entities[0].number;
        if (moved[vertex] == 0) return false;
        const auto& [a, b] = maps.midpoint_to_edge[vertex - maps.first_midpoint.value()];
        const CellVertices& cell = fine.cells[CellIndex{violation.entities[1].number}];
        return std::ranges::count(cell, a) == 0 || std::ranges::count(cell, b) == 0;
    });
}

}  // namespace

std::string fault_of_equality(const Case& c) {
    const Outcome expected = refined_by_reference(c);
    const Outcome found = refined_by_all(c);
    if (found.error != expected.error) {
        return "refused as '" + found.error + "', by the reference as '" + expected.error + "'";
    }
    if (!expected.error.empty()) return {};
    if (!(found.mesh.cells == expected.mesh.cells)) return "the engines' cells differ";
    if (test::bits(found.mesh) != test::bits(expected.mesh)) return "the engines' points differ";
    if (!(found.mesh == expected.mesh)) return "the engines' tags, markers or attributes differ";
    if (!(found.maps == expected.maps)) return "the engines' maps differ";
    const verify::Verdict verdict =
        verify::verify_refinement(c.mesh, found.mesh,
                                  {.request = verify::Request{c.selection, c.scheme, c.levels},
                                   .closure = c.closure,
                                   .maps = &found.maps});
    if (verdict.valid() || may_meet_by_rounding(found.mesh, found.maps, verdict.violations))
        return {};
    return "the verifier finds: " + test::codes_of(verdict);
}

}  // namespace octetra::properties
