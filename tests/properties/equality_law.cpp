#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <octetra/core/edge_order.hpp>
#include <octetra/verify/verify.hpp>

#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/bits.hpp"
#include "support/refinement.hpp"
#include "verify/verdicts.hpp"

namespace octetra::properties {
namespace {

double shortest_edge(const Mesh& mesh) {
    double shortest = std::numeric_limits<double>::infinity();
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners corners = test::corners_of(mesh, c);
        for (const auto& [i, j] : cell_edges) {
            shortest = std::min(shortest, std::sqrt(squared_length({corners[i], corners[j]})));
        }
    }
    return shortest;
}

/// Between the numbers that are farthest from zero.
double largest_spacing(const Mesh& mesh) {
    double far = 0;
    for (const Point& p : mesh.points) {
        far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return std::nextafter(far, std::numeric_limits<double>::infinity()) - far;
}

/// Where edges are hardly longer than numbers are apart, a rounded midpoint may come to lie on a
/// cell, or in one, that has no face in common with its own. No engine looks for that; the verifier
/// finds it.
bool may_meet_by_rounding(const Mesh& fine, const verify::Verdict& verdict) {
    const std::string codes = test::codes_of(verdict);
    return (codes == "hanging_vertex" || codes == "vertex_in_cell" ||
            codes == "hanging_vertex vertex_in_cell") &&
           largest_spacing(fine) > shortest_edge(fine) / 1000;
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
    const verify::Verdict verdict = verify::verify_refinement(
        c.mesh, found.mesh,
        {.request = verify::Request{c.selection, c.scheme, c.levels}, .maps = &found.maps});
    if (verdict.valid() || may_meet_by_rounding(found.mesh, verdict)) return {};
    return "the verifier finds: " + test::codes_of(verdict);
}

}  // namespace octetra::properties
