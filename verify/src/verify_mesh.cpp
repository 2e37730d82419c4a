#include <octetra/verify/verify.hpp>

#include <octetra/core/standard_arithmetic.hpp>

#include "measures/angles.hpp"

#include "measures/sums.hpp"
#include "mesh/boundary.hpp"
#include "mesh/checks.hpp"
#include "parts/mesh_part.hpp"
#include "same_options.hpp"

namespace octetra::verify {
namespace {

/// Runs the checks of a mesh, or a part of one, whose numbers are in range.
void judge(JudgedMesh& judged, const VerifyOptions& options, Findings& findings) {
    const bool well_formed =
        findings.run("well-formed", [&] { return check_well_formed(judged, findings); });
    findings.run("markers", [&] { return check_tagged_markers(judged, findings); });
    const bool no_coincidence = findings.run(
        "vertices", [&] { return check_vertices(judged, {}, Unused::noted, findings); });
    const bool oriented =
        findings.run("orientation", [&] { return check_orientation(judged, findings); });
    const bool faced = findings.run("faces", [&] { return check_faces(judged, findings); });
    count_singular(judged, findings.facts());
    if (options.fast) {
        findings.skip("hanging vertices", not_fast);
        findings.skip("boundary crossings", not_fast);
        return;
    }
    // Invalid cells would cause further violations; one report of them is sufficient.
    bool none_hangs = false;
    bool proven = false;
    if (oriented && faced) {
        none_hangs = findings.run("hanging vertices", [&] {
            proven = well_formed && boundary_proves_conformity(judged, findings);
            return proven ? std::string() : check_hanging(judged, findings);
        });
    } else {
        findings.skip("hanging vertices", "there are invalid cells");
    }
    if (no_coincidence && none_hangs) {
        findings.run("boundary crossings", [&] {
            return proven ? std::string() : check_boundary_crossings(judged, findings);
        });
    } else {
        findings.skip("boundary crossings", oriented && faced
                                                ? "there are coincident or hanging vertices"
                                                : "there are invalid cells");
    }
    findings.verdict().angles = measure_angles(judged, findings.group());
    measure_sums(judged, findings);
    if (options.min_dihedral) {
        findings.run("dihedral angles", [&] {
            return check_dihedral_angles(judged, *options.min_dihedral, findings);
        });
    }
}

}  // namespace

Verdict verify_mesh(const Mesh& mesh, const VerifyOptions& options) {
    const StandardArithmetic standard;
    Findings findings(options.kept_per_code, ProcessGroup::alone(), options.progress);
    JudgedMesh judged = judged_whole(mesh, Which::fine);
    if (findings.run("numbers in range", [&] {
            return check_ranges(mesh, mesh.points.size(), Which::fine, findings);
        })) {
        judge(judged, options, findings);
    }
    return findings.finish();
}

Verdict verify_mesh(MeshSlice mesh, const ProcessGroup& group, const VerifyOptions& options) {
    if (group.size() == 1) return verify_mesh(mesh.lists, options);
    const StandardArithmetic standard;
    check_same_options(group, options);
    Findings findings(options.kept_per_code, group, options.progress);
    if (!findings.run("numbers in range",
                      [&] { return check_slice_ranges(mesh, Which::fine, findings); })) {
        return findings.finish();
    }
    const Totals totals = mesh.totals;
    const Parts parts = part_of(std::move(mesh), group);
    findings.translate(Which::fine, &parts.fine.numbers);
    JudgedMesh judged{.mesh = parts.fine.mesh, .domain = parts.domain, .totals = totals};
    judge(judged, options, findings);
    return findings.finish();
}

}  // namespace octetra::verify
