#include "verdict/print_verdict.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "grouped.hpp"
#include "terminal.hpp"
#include "verdict/describe.hpp"

namespace octetra::cli {
namespace {

using verify::Code;
using verify::Verdict;
using verify::Violation;

constexpr std::size_t shown_of_each_code = 5;

void print_checks(const Verdict& verdict) {
    for (const verify::Check& check : verdict.checks) {
        if (check.note.empty()) {
            print("{:<22} {}\n", check.name, word_of(check.status));
        } else {
            print("{:<22} {:<8} {}\n", check.name, word_of(check.status), check.note);
        }
    }
}

void print_violation(const Violation& violation, const JudgedFiles& judged) {
    std::string entities;
    for (const verify::Entity& entity : violation.entities) {
        entities += (entities.empty() ? "" : ", ") + describe(entity, judged);
    }
    print("  {}{}found {}; expected {}\n", entities, entities.empty() ? "" : ": ", violation.found,
          violation.expected);
}

void print_violations(const Verdict& verdict, const JudgedFiles& judged) {
    for (std::size_t code = 0; code < verify::code_count; ++code) {
        const std::uint64_t count = verdict.counts[code];
        if (count == 0) continue;
        print("\n{}: {}\n", name(static_cast<Code>(code)), grouped(count));
        std::size_t shown = 0;
        for (const Violation& violation : verdict.violations) {
            if (violation.code != static_cast<Code>(code)) continue;
            if (shown++ == shown_of_each_code) break;
            print_violation(violation, judged);
        }
        if (count > shown_of_each_code) {
            print("  and {} more\n", grouped(count - shown_of_each_code));
        }
    }
}

/// Prints to which files numbers refer, if the files have different index bases.
void print_index_bases(const Verdict& verdict, const JudgedFiles& judged) {
    if (verdict.valid() || judged.coarse.empty()) return;
    if (judged.fine_index_base == judged.coarse_index_base) return;
    print(
        "\nNumbers refer to {}, which counts from {}; those of {} entities refer to {}, "
        "which counts from {}.\n",
        judged.fine, judged.fine_index_base, judged.is_coarsened ? "coarse or previous" : "coarse",
        judged.coarse, judged.coarse_index_base);
}

void print_fact(std::string_view what, const std::string& value) {
    print("{:<30} {:>16}\n", what, value);
}

void print_angles(std::string_view of, const verify::AngleFigures& angles) {
    print_fact(fmt::format("{}dihedral angles, degrees", of),
               fmt::format("{:.6g} .. {:.6g}", angles.min_dihedral, angles.max_dihedral));
    print_fact(fmt::format("{}least solid angle, sr", of), fmt::format("{:.6g}", angles.min_solid));
    print_fact(fmt::format("{}least eta", of), fmt::format("{:.6g}", angles.min_eta));
}

/// Prints the first ones.
void print_sums(std::string_view what, const std::vector<verify::TagSum>& sums,
                bool of_refinement) {
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, sums.size()); ++i) {
        const verify::TagSum& sum = sums[i];
        std::string value = fmt::format("{:.9g}", sum.fine);
        if (of_refinement) {
            value += fmt::format("  coarse {:.9g}, difference {:.3g}", sum.coarse, sum.difference);
        }
        print_fact(fmt::format("{} {}", what, sum.tag), value);
    }
    if (sums.size() > shown) print_fact("further ones", grouped(sums.size() - shown));
}

void print_facts(const Verdict& verdict, bool of_refinement) {
    const verify::Facts& facts = verdict.facts;
    print_text("\n");
    print_fact("vertices", grouped(facts.vertices));
    print_fact("cells", grouped(facts.cells));
    print_fact("boundary faces", grouped(facts.boundary_faces));
    print_fact("singular edges", grouped(facts.singular_edges));
    print_fact("singular vertices", grouped(facts.singular_vertices));
    if (of_refinement) {
        print_fact("undivided coarse cells", grouped(facts.cells_kept));
        print_fact("midpoints", grouped(facts.bisected_edges));
        print_fact("rounded midpoints", grouped(facts.rounded_midpoints));
    }
    print_sums("volume of region", verdict.volumes, of_refinement);
    print_sums("area of marker", verdict.areas, of_refinement);
    if (verdict.coarse_angles && facts.cells > 0) print_angles("coarse ", *verdict.coarse_angles);
    if (verdict.angles && facts.cells > 0) print_angles("", *verdict.angles);
    print_fact("decisions by filters", grouped(verdict.arithmetic.filtered));
    print_fact("decisions by exact arithmetic", grouped(verdict.arithmetic.exact));
}

}  // namespace

void print_verdict(const Verdict& verdict, const JudgedFiles& judged) {
    print_checks(verdict);
    print_violations(verdict, judged);
    print_index_bases(verdict, judged);
    print_facts(verdict, !judged.coarse.empty());
    const bool fast = std::any_of(verdict.checks.begin(), verdict.checks.end(),
                                  [](const auto& check) { return check.note == verify::not_fast; });
    const std::string_view answer = !verdict.valid() ? "NOT VALID"
                                    : fast           ? "valid, as far as --fast checks"
                                                     : "valid";
    if (judged.coarse.empty()) {
        print("\n{}: {}\n", judged.fine, answer);
    } else {
        print("\n{} as {} of {}: {}\n", judged.fine,
              judged.is_coarsened ? "a coarsening" : "a refinement", judged.coarse, answer);
    }
}

void print_comparison(const verify::Comparison& comparison, const std::string& a,
                      const std::string& b) {
    for (const verify::Difference& difference : comparison.differences) {
        std::string corners;
        for (const Point& p : difference.corners) {
            corners += fmt::format(" ({}, {}, {})", p.x, p.y, p.z);
        }
        print("{} at{}: {} in {}, {} in {}\n", difference.kind, corners, difference.in_a, a,
              difference.in_b, b);
    }
    const std::uint64_t more = comparison.difference_count - comparison.differences.size();
    if (more > 0) print("and {} more differences\n", grouped(more));
    if (comparison.greatest_distance > 0 && comparison.difference_count == 0) {
        print("{}, {}: the same within the tolerance: vertices are up to {:.3g} apart\n", a, b,
              comparison.greatest_distance);
        return;
    }
    constexpr std::array<std::string_view, 3> answers{"identical", "the same up to numbering",
                                                      "different"};
    std::vector<std::string_view> reasons;
    if (comparison.index_base_differs) reasons.push_back("one counts from 0, the other from 1");
    if (comparison.signs_of_zeros_differ) reasons.push_back("some zeros have another sign");
    if (comparison.zero_tags_differ) {
        reasons.push_back("one has markers or region tags that are all 0, the other has none");
    }
    print("{}, {}: {}{}\n", a, b, answers[static_cast<std::size_t>(comparison.likeness)],
          reasons.empty()
              ? ""
              : fmt::format(": {}, and nothing else differs", fmt::join(reasons, "; ")));
}

}  // namespace octetra::cli
