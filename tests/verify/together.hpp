#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <octetra/verify/verify.hpp>

#include "verify/thread_group.hpp"

namespace octetra::test {

inline std::string verdict_text(const verify::Entity& entity) {
    std::string vertices;
    for (const VertexIndex v : entity.vertices) vertices += fmt::format(" {}", v.value());
    return fmt::format("{}/{}/{}({})", static_cast<int>(entity.kind), static_cast<int>(entity.mesh),
                       entity.number, vertices);
}

inline std::string verdict_text(const std::optional<verify::AngleFigures>& angles) {
    if (!angles) return "none";
    return fmt::format("{} at {}, {}, {}, {}", angles->min_dihedral,
                       angles->min_dihedral_at.value(), angles->max_dihedral, angles->min_solid,
                       angles->min_eta);
}

/// Everything of a verdict that must not depend on the number of processes: all but times and
/// arithmetic.
inline std::string verdict_text(const verify::Verdict& verdict) {
    std::string text;
    for (const verify::Check& check : verdict.checks) {
        text += fmt::format("{}: {} {}\n", check.name, static_cast<int>(check.status), check.note);
    }
    text += fmt::format("counts {}\n", fmt::join(verdict.counts, " "));
    for (const verify::Violation& violation : verdict.violations) {
        text += fmt::format("{}", name(violation.code));
        for (const verify::Entity& entity : violation.entities)
            text += fmt::format(" {}", verdict_text(entity));
        text += fmt::format(": {}; {}\n", violation.found, violation.expected);
    }
    const verify::Facts& f = verdict.facts;
    text += fmt::format("facts {} {} {} {} {} {} {} {} {} {} {} {} {}\n", f.vertices, f.cells,
                        f.edges, f.faces, f.boundary_faces, f.singular_edges, f.singular_vertices,
                        f.unused_vertices, f.bisected_edges, f.rounded_midpoints, f.cells_kept,
                        f.deepest, f.rounding_bound);
    text += fmt::format("angles {}\ncoarse {}\n", verdict_text(verdict.angles),
                        verdict_text(verdict.coarse_angles));
    for (const auto* sums : {&verdict.volumes, &verdict.areas}) {
        for (const verify::TagSum& sum : *sums) {
            text +=
                fmt::format("sum of {}: {} {} {}\n", sum.tag, sum.fine, sum.coarse, sum.difference);
        }
    }
    for (const verify::DepthFigures& figures : verdict.by_depth) {
        text += fmt::format("depth {}: {} {} {}\n", figures.depth, figures.cells,
                            figures.min_dihedral, figures.min_eta);
    }
    return text;
}

using GroupSizes = std::vector<int>;
inline const GroupSizes all_group_sizes{2, 3, 7};

inline void expect_same_verdict_together(
    const verify::Verdict& alone, const std::function<verify::Verdict(const ProcessGroup&)>& judge,
    const GroupSizes& sizes = all_group_sizes) {
    for (const int size : sizes) {
        SCOPED_TRACE(fmt::format("{} processes", size));
        verify::Verdict first;
        run_together(size, [&](const ProcessGroup& group) {
            verify::Verdict verdict = judge(group);
            if (group.is_first()) {
                first = std::move(verdict);
            } else if (verdict.valid() != alone.valid()) {
                ADD_FAILURE() << "another verdict on process " << group.rank();
            }
        });
        ASSERT_EQ(verdict_text(first), verdict_text(alone));
    }
}

/// Returns the verdict of this process alone; checks that those of groups of 2, 3 and 7 are the
/// same.
inline verify::Verdict verified_by_all(const Mesh& mesh,
                                       const verify::VerifyOptions& options = {}) {
    const verify::Verdict alone = verify_mesh(mesh, options);
    expect_same_verdict_together(alone, [&](const ProcessGroup& group) {
        return verify_mesh(verify::distribute_slices(mesh, group), group, options);
    });
    return alone;
}

inline verify::Verdict verified_by_all(const Mesh& coarse, const Mesh& fine,
                                       const verify::VerifyOptions& options = {},
                                       const GroupSizes& sizes = all_group_sizes) {
    const verify::Verdict alone = verify_refinement(coarse, fine, options);
    const auto judge = [&](const ProcessGroup& group) {
        return verify_refinement(verify::distribute_slices(coarse, group),
                                 verify::distribute_slices(fine, group), group, options);
    };
    expect_same_verdict_together(alone, judge, sizes);
    return alone;
}

}  // namespace octetra::test
