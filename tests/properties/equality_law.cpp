#include <octetra/verify/verify.hpp>

#include "properties/laws.hpp"
#include "properties/team.hpp"
#include "support/bits.hpp"
#include "verify/verdicts.hpp"

namespace octetra::properties {

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
    if (!verdict.valid()) return "the verifier finds: " + test::codes_of(verdict);
    return {};
}

}  // namespace octetra::properties
