#include <octetra/verify/verify_coarsening.hpp>

#include <optional>
#include <string>

#include <fmt/format.h>

#include <octetra/core/standard_arithmetic.hpp>

#include "coarsening/checks.hpp"

#include "judge_refinement.hpp"

namespace octetra::verify {
namespace {

/// Runs the checks that need the mesh before, each only if the checks that it depends on have
/// passed.
void judge_remainder(const Mesh& input, const StepCuts& steps, const CoarseningRequest& request,
                     const Mesh& after, Findings& findings) {
    std::optional<Lineage> lineage;
    findings.run("steps before", [&] {
        lineage = lineage_of(input, steps);
        return fmt::format("{}, to {} vertices and {} cells; each closed", lineage->steps,
                           lineage->points.size(), lineage->cells.present.size());
    });
    const Remainder rest = remainder_of(*lineage, input, request);
    VertexMatch match;
    const bool right_vertices = findings.run("vertices that stay", [&] {
        return check_kept_vertices(*lineage, rest, after, match, findings);
    });
    const bool right_unions = findings.run("unions of cells", [&] {
        return check_unions(*lineage, request.levels, after, match, findings);
    });
    if (right_vertices && right_unions) {
        findings.run("pieces", [&] { return check_pieces(rest, after, match, findings); });
    } else {
        findings.skip("pieces",
                      right_vertices ? "unions of cells failed" : "vertices that stay failed");
    }
}

}  // namespace

Verdict verify_coarsening(const Mesh& input, const StepCuts& steps,
                          const CoarseningRequest& request, const Mesh& after,
                          const VerifyOptions& options) {
    const StandardArithmetic standard;
    Findings findings(options.kept_per_code, ProcessGroup::alone(), options.progress);
    VerifyOptions of_refinement = options;
    of_refinement.request.reset();
    if (judge_refinement(input, after, of_refinement, findings)) {
        judge_remainder(input, steps, request, after, findings);
    } else {
        const std::string failed = findings.what_failed();
        for (const char* name :
             {"steps before", "vertices that stay", "unions of cells", "pieces"}) {
            findings.skip(name, failed);
        }
    }
    return findings.finish();
}

}  // namespace octetra::verify
