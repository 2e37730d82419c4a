#include <octetra/verify/verify.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "judge_refinement.hpp"

#include "measures/angles.hpp"
#include "measures/sums.hpp"
#include "mesh/boundary.hpp"
#include "mesh/checks.hpp"
#include "parts/mesh_part.hpp"
#include "refinement/checks.hpp"
#include "request/replays.hpp"
#include "same_options.hpp"

namespace octetra::verify {
namespace {

/// Tolerates coincident vertices of the fine mesh that are midpoints of different edges which also
/// coincide, as at a crack of which the coarse mesh has both sides.
void tolerate_sides_of_cracks(const Mesh& fine, const Descent& descent,
                              std::vector<char>& tolerated) {
    std::vector<VertexIndex> by_place;
    for (VertexIndex v{0}; v < fine.points.end_index(); ++v) by_place.push_back(v);
    std::sort(by_place.begin(), by_place.end(),
              [&](VertexIndex v, VertexIndex w) { return fine.points[v] < fine.points[w]; });
    const auto lie_together = [&](VertexIndex v, VertexIndex w) {
        EdgeVertices a = descent.halves[v];
        EdgeVertices b = descent.halves[w];
        if (a[0].is_none() || b[0].is_none()) return false;
        if (fine.points[a[0]] != fine.points[b[0]]) std::swap(b[0], b[1]);
        return a != b && fine.points[a[0]] == fine.points[b[0]] &&
               fine.points[a[1]] == fine.points[b[1]];
    };
    for (std::size_t begin = 0, end = 0; begin < by_place.size(); begin = end) {
        while (end < by_place.size() &&
               fine.points[by_place[begin]] == fine.points[by_place[end]]) {
            ++end;
        }
        bool all = end - begin > 1;
        for (std::size_t i = begin; all && i < end; ++i) {
            for (std::size_t k = begin; all && k < i; ++k) {
                all = lie_together(by_place[i], by_place[k]);
            }
        }
        for (std::size_t i = begin; all && i < end; ++i) tolerated[by_place[i].value()] = 1;
    }
}

/// Returns, for each vertex, whether it may be unused or coincide with another. This is inherited:
/// by vertices of no coarse cell, by coincident vertices of the coarse mesh (at a crack, for
/// example), and by midpoints between these, if they are midpoints of different edges.
std::vector<char> inherited_freedom(const Mesh& coarse, const Mesh& fine, const Descent& descent) {
    const std::vector<char> used = used_vertices(coarse);
    std::vector<VertexIndex> by_place;
    for (VertexIndex v{0}; v < coarse.points.end_index(); ++v) by_place.push_back(v);
    std::sort(by_place.begin(), by_place.end(),
              [&](VertexIndex v, VertexIndex w) { return coarse.points[v] < coarse.points[w]; });
    std::vector<char> tolerated(fine.points.size(), 0);
    const auto tolerate = [&](VertexIndex coarse_vertex) {
        const VertexIndex v = descent.coarse_to_fine[coarse_vertex];
        if (!v.is_none()) tolerated[v.value()] = 1;
    };
    for (VertexIndex v{0}; v < coarse.points.end_index(); ++v) {
        if (used[v.value()] == 0) tolerate(v);
    }
    bool any_coincident = false;
    for (std::size_t i = 1; i < by_place.size(); ++i) {
        if (coarse.points[by_place[i - 1]] != coarse.points[by_place[i]]) continue;
        tolerate(by_place[i - 1]);
        tolerate(by_place[i]);
        any_coincident = true;
    }
    if (!any_coincident) return tolerated;
    tolerate_sides_of_cracks(fine, descent, tolerated);
    // Terminates, because `halves` of a midpoint were set after those of its ends.
    for (bool changed = true; changed;) {
        changed = false;
        for (VertexIndex v{0}; v < fine.points.end_index(); ++v) {
            const auto& [a, b] = descent.halves[v];
            if (tolerated[v.value()] != 0 || a.is_none()) continue;
            if (tolerated[a.value()] == 0 || tolerated[b.value()] == 0) continue;
            tolerated[v.value()] = 1;
            changed = true;
        }
    }
    return tolerated;
}

/// Returns whether any vertices of cells coincide.
bool has_coincident_vertices(const JudgedMesh& judged) {
    const std::vector<char> used = used_vertices(judged.mesh);
    std::vector<Point> points;
    for (VertexIndex v{0}; v < judged.mesh.points.end_index(); ++v) {
        if (used[v.value()] != 0 && judged.owns(v)) points.push_back(judged.mesh.points[v]);
    }
    std::sort(points.begin(), points.end());
    return std::adjacent_find(points.begin(), points.end()) != points.end();
}

void check_request_of_closure(const VerifyOptions& options) {
    if (options.closure == Closure::longest_edge || !options.request) return;
    if (options.request->scheme == Scheme::eight) return;
    throw InputError("the regular closure requires a request with the scheme 8t");
}

std::string_view name_of_range_check(Which which) {
    return which == Which::fine ? "numbers in range" : "coarse mesh in range";
}

/// Runs the checks of two meshes whose numbers are in range, in sequence, each only if the checks
/// that it depends on have passed.
class RefinementCheck {
public:
    RefinementCheck(JudgedMesh coarse, JudgedMesh fine, const VerifyOptions& options,
                    Findings& findings)
        : options_(options),
          findings_(findings),
          coarse_(std::move(coarse)),
          fine_(std::move(fine)) {}

    /// Returns false if the coarse mesh is invalid.
    bool judge() {
        if (!judge_coarse()) return false;
        const bool well_formed =
            findings_.run("well-formed", [&] { return check_well_formed(fine_, findings_); });
        const bool oriented =
            findings_.run("orientation", [&] { return check_orientation(fine_, findings_); });
        const bool faced = findings_.run("faces", [&] { return check_faces(fine_, findings_); });
        count_singular(fine_, findings_.facts());
        judge_descent(well_formed && oriented && faced);
        if (!options_.fast && !findings_.verdict().angles) {
            findings_.verdict().angles = measure_angles(fine_, findings_.group());
        }
        if (!options_.fast && options_.min_dihedral) {
            findings_.run("dihedral angles", [&] {
                return check_dihedral_angles(fine_, *options_.min_dihedral, findings_);
            });
        }
        return true;
    }

private:
    /// Checks the assumptions of the proof about the coarse mesh.
    bool judge_coarse() {
        return findings_.run("coarse mesh", [&] {
            (void)check_well_formed(coarse_, findings_);
            (void)check_tagged_markers(coarse_, findings_);
            (void)check_orientation(coarse_, findings_);
            (void)check_faces(coarse_, findings_);
            const Facts none;
            findings_.facts() = none;  // set for the fine mesh later
            if (!options_.fast)
                findings_.verdict().coarse_angles = measure_angles(coarse_, findings_.group());
            return std::string("well-formed, oriented, at most two cells at a face");
        });
    }

    void judge_descent(bool conforms) {
        const PointLookup places(fine_.mesh.points);
        Descent descent;
        const bool none_lost = findings_.run("coarse vertices", [&] {
            return find_coarse_vertices(coarse_, fine_, places, descent, findings_);
        });
        const bool coincidences =
            options_.fast || any(findings_.group(), has_coincident_vertices(coarse_));
        bool none_hangs = true;
        if (options_.fast) {
            findings_.skip("hanging vertices", not_fast);
        } else if (!conforms) {
            findings_.skip("hanging vertices", "there are invalid cells");
        } else if (coincidences) {
            findings_.skip("hanging vertices",
                           "the coarse mesh has coincident vertices, possibly a crack");
        } else {
            none_hangs = findings_.run("hanging vertices", [&] {
                const bool proven = boundary_proves_conformity(fine_, findings_);
                return proven ? std::string() : check_hanging(fine_, findings_);
            });
        }
        Lines lines(fine_, places);
        if (!conforms || !none_lost || !none_hangs) {
            skip_from(0, findings_.what_failed());
            return;
        }
        if (!findings_.run("descent", [&] {
                return check_descent(coarse_, fine_, lines, descent, findings_);
            })) {
            skip_from(1, "descent failed");
            return;
        }
        judge_descendants(descent, lines);
    }

    void judge_descendants(const Descent& descent, Lines& lines) {
        findings_.run("vertices", [&] {
            return check_vertices(fine_, inherited_freedom(coarse_.mesh, fine_.mesh, descent),
                                  Unused::violation, findings_);
        });
        const bool covered =
            findings_.run("cover", [&] { return check_cover(coarse_, fine_, descent, findings_); });
        if (options_.fast) {
            findings_.skip("volumes of cells", not_fast);
            findings_.skip("face angles", not_fast);
        } else if (!covered) {
            findings_.skip("volumes of cells", "cover failed");
            findings_.skip("face angles", "cover failed");
        } else {
            findings_.run("volumes of cells",
                          [&] { return check_volumes(coarse_, fine_, descent, findings_); });
            findings_.run("face angles",
                          [&] { return check_face_angles(coarse_, fine_, descent, findings_); });
            AnglesByDepth angles = measure_by_depth(fine_, descent, findings_.group());
            findings_.verdict().angles = angles.all;
            findings_.verdict().by_depth = std::move(angles.by_depth);
        }
        check_tags(coarse_, fine_, lines, descent, options_, findings_);
        if (options_.fast) {
            findings_.skip("sums by tag", not_fast);
        } else if (const std::string failed = findings_.what_failed(); !failed.empty()) {
            findings_.skip("sums by tag", failed);
        } else {
            findings_.run("sums by tag",
                          [&] { return check_sums(coarse_, fine_, descent, findings_); });
        }
        if (options_.maps != nullptr) {
            findings_.run("maps", [&] {
                return check_maps(*options_.maps, coarse_, fine_, descent, findings_);
            });
        }
        judge_closure(descent, lines);
    }

    void judge_closure(const Descent& descent, Lines& lines) {
        const bool is_regular = options_.closure == Closure::regular;
        if (is_regular && options_.fast) {
            findings_.skip("certified shapes", not_fast);
        } else if (is_regular) {
            findings_.run("certified shapes", [&] {
                return check_certified_shapes(coarse_, fine_, descent, findings_);
            });
        }
        const bool is_closed = !is_regular || findings_.run("regular closure", [&] {
            return check_regular_closure(coarse_, fine_, lines, descent, findings_);
        });
        if (!options_.request) return;
        if (!is_closed) {
            findings_.skip("8T-LE", "regular closure failed");
            return;
        }
        findings_.run("8T-LE", [&] {
            const RequestedRefinement asked(*options_.request, coarse_, fine_, lines, descent,
                                            findings_);
            return is_regular ? replay_regular_closure(asked) : replay_longest_edge_closure(asked);
        });
    }

    void skip_from(std::size_t first, std::string_view why) {
        constexpr std::array<std::string_view, 6> names{
            "descent", "vertices", "cover", "volumes of cells", "face angles", "sums by tag"};
        for (std::size_t i = first; i < names.size(); ++i) findings_.skip(names[i], why);
        if (options_.maps != nullptr) findings_.skip("maps", why);
        if (options_.closure == Closure::regular) {
            findings_.skip("certified shapes", why);
            findings_.skip("regular closure", why);
        }
        if (options_.request) findings_.skip("8T-LE", why);
    }

    const VerifyOptions& options_;
    Findings& findings_;
    JudgedMesh coarse_;
    JudgedMesh fine_;
};

}  // namespace

bool judge_refinement(const Mesh& coarse, const Mesh& fine, const VerifyOptions& options,
                      Findings& findings) {
    const auto in_range = [&](const Mesh& mesh, Which which) {
        return findings.run(name_of_range_check(which), [&] {
            return check_ranges(mesh, mesh.points.size(), which, findings);
        });
    };
    return in_range(coarse, Which::coarse) && in_range(fine, Which::fine) &&
           RefinementCheck(judged_whole(coarse, Which::coarse), judged_whole(fine, Which::fine),
                           options, findings)
               .judge();
}

Verdict verify_refinement(const Mesh& coarse, const Mesh& fine, const VerifyOptions& options) {
    const StandardArithmetic standard;
    check_request_of_closure(options);
    Findings findings(options.kept_per_code, ProcessGroup::alone(), options.progress);
    (void)judge_refinement(coarse, fine, options, findings);
    return findings.finish();
}

Verdict verify_refinement(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group,
                          const VerifyOptions& options) {
    if (group.size() == 1) return verify_refinement(coarse.lists, fine.lists, options);
    const StandardArithmetic standard;
    check_same_options(group, options);
    check_request_of_closure(options);
    Findings findings(options.kept_per_code, group, options.progress);
    const auto in_range = [&](const MeshSlice& slice, Which which) {
        return findings.run(name_of_range_check(which),
                            [&] { return check_slice_ranges(slice, which, findings); });
    };
    if (!in_range(coarse, Which::coarse) || !in_range(fine, Which::fine)) return findings.finish();
    const Totals coarse_totals = coarse.totals;
    const Totals fine_totals = fine.totals;
    const Parts parts = parts_of(std::move(coarse), std::move(fine), group);
    findings.translate(Which::coarse, &parts.coarse.numbers);
    findings.translate(Which::fine, &parts.fine.numbers);
    (void)RefinementCheck({.mesh = parts.coarse.mesh,
                           .which = Which::coarse,
                           .domain = parts.domain,
                           .totals = coarse_totals,
                           .views = parts.coarse_in_view},
                          {.mesh = parts.fine.mesh, .domain = parts.domain, .totals = fine_totals},
                          options, findings)
        .judge();
    return findings.finish();
}

}  // namespace octetra::verify
