#include <octetra/verify/verify.hpp>

#include "angles.hpp"
#include "subject.hpp"
#include "sums.hpp"

namespace octetra::verify {

Verdict verify_mesh(const Mesh& mesh, const VerifyOptions& options) {
    Findings findings(options.kept_per_code);
    Subject subject{.mesh = mesh};
    if (!findings.run("numbers in range",
                      [&] { return check_ranges(mesh, Which::fine, findings); })) {
        return std::move(findings.verdict());
    }
    findings.run("well-formed", [&] { return check_well_formed(subject, findings); });
    findings.run("markers", [&] { return check_listed_markers(subject, findings); });
    const bool no_coincidence =
        findings.run("vertices", [&] { return check_vertices(subject, {}, findings); });
    const bool oriented =
        findings.run("orientation", [&] { return check_orientation(subject, findings); });
    const bool faced = findings.run("faces", [&] { return check_faces(subject, findings); });
    count_singular(subject, findings.facts());
    if (options.fast) {
        findings.skip("hanging vertices", "not with --fast");
        findings.skip("boundary crossings", "not with --fast");
        return std::move(findings.verdict());
    }
    // Cells that are wrong in themselves are in others' way, too; one report of them is enough.
    bool none_hangs = false;
    if (oriented && faced) {
        none_hangs =
            findings.run("hanging vertices", [&] { return check_hanging(subject, findings); });
    } else {
        findings.skip("hanging vertices", "cells are wrong in themselves");
    }
    if (no_coincidence && none_hangs) {
        findings.run("boundary crossings",
                     [&] { return check_boundary_crossings(subject, findings); });
    } else {
        findings.skip("boundary crossings", oriented && faced ? "vertices lie where they must not"
                                                              : "cells are wrong in themselves");
    }
    findings.verdict().angles = measure_angles(subject);
    measure_sums(subject, findings.verdict());
    if (options.min_dihedral) {
        findings.run("dihedral angles", [&] {
            return check_dihedral_angles(subject, *options.min_dihedral, findings);
        });
    }
    return std::move(findings.verdict());
}

}  // namespace octetra::verify
