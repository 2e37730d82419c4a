#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/random_history.hpp"
#include "support/coarsening.hpp"
#include "verify/coarsening.hpp"
#include "verify/verdicts.hpp"

/// Each kind of wrong coarsened mesh, and the message about it.
namespace octetra::verify {
namespace {

using reference::Call;
using reference::CellMarks;
using reference::History;
using reference::refined;
using test::codes_of;
using test::mesh_of_history;
using test::request_of;
using testing::HasSubstr;

Verdict judged(const Call& call, const Mesh& after) {
    return verify_coarsening(call.before.input, test::cuts_of(call.before), request_of(call.marked),
                             after);
}

std::vector<Call> coarsenings_of_all_seeds() {
    std::vector<Call> calls;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        for (const Call& call : reference::random_coarsenings(seed)) calls.push_back(call);
    }
    return calls;
}

/// Returns whether this midpoint can be removed so that the result is another valid mesh: any
/// midpoint of the last step; of other steps those that leave the step closed.
bool is_removable(std::size_t v, const History& history) {
    const auto step = static_cast<std::size_t>(test::steps_of_vertices(history)[v]);
    if (step == history.steps.size()) return true;
    std::size_t first = history.input.points.size();
    for (std::size_t t = 0; t + 1 < step; ++t) first += history.steps[t].size();
    auto edges = history.steps[step - 1];
    edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(v - first));
    return test::is_closed(reference::replay(history)[step - 1].mesh, edges);
}

TEST(CoarseningFaults, OneMissingVertexIsRefused) {
    int tried = 0;
    for (const Call& call : coarsenings_of_all_seeds()) {
        std::size_t nth = 0;
        for (const std::size_t v : test::midpoints_on_top(call.after)) {
            if (++nth % 7 != 1 || !is_removable(v, call.after)) continue;
            std::vector<char> stays(test::steps_of_vertices(call.after).size(), 1);
            stays[v] = 0;
            const Mesh after = mesh_of_history(test::history_with(stays, call.after));
            const Verdict verdict = judged(call, after);
            EXPECT_EQ(verdict.count(Code::vertex_went), 1U) << codes_of(verdict);
            EXPECT_EQ(verdict.count(Code::vertex_stayed), 0U) << codes_of(verdict);
            ++tried;
        }
    }
    EXPECT_GT(tried, 100);
}

TEST(CoarseningFaults, OneSuperfluousVertexIsRefused) {
    int tried = 0;
    for (const Call& call : coarsenings_of_all_seeds()) {
        std::vector<char> stays = test::remaining_vertices(call.after, call.before);
        std::size_t nth = 0;
        for (std::size_t v = 0; v < stays.size(); ++v) {
            if (stays[v] != 0 || ++nth % 4 != 1) continue;
            stays[v] = 1;
            const Mesh after = mesh_of_history(test::history_with(stays, call.before));
            stays[v] = 0;
            const Verdict verdict = judged(call, after);
            EXPECT_EQ(verdict.count(Code::vertex_stayed), 1U) << codes_of(verdict);
            EXPECT_EQ(verdict.count(Code::vertex_went), 0U) << codes_of(verdict);
            ++tried;
        }
    }
    EXPECT_GT(tried, 100);
}

/// The vertices that rule (a) alone requires: the last step is then not closed.
TEST(CoarseningFaults, WithoutClosureIsRefused) {
    int tried = 0;
    for (const Call& call : coarsenings_of_all_seeds()) {
        const auto required = test::points_that_stay(call.before, call.marked);
        const Mesh present = mesh_of_history(call.before);
        const std::vector<int> steps = test::steps_of_vertices(call.before);
        std::vector<char> stays;
        std::uint64_t dropped = 0;
        bool in_last_step = true;
        for (const Point& p : present.points) {
            const bool by_closure = required.all.contains(p) && !required.by_cells.contains(p);
            if (by_closure) ++dropped;
            if (by_closure && steps[stays.size()] < steps.back()) in_last_step = false;
            stays.push_back(required.by_cells.contains(p) ? 1 : 0);
        }
        if (dropped == 0 || !in_last_step) continue;
        const Verdict verdict =
            judged(call, mesh_of_history(test::history_with(stays, call.before)));
        EXPECT_EQ(verdict.count(Code::vertex_went), dropped) << codes_of(verdict);
        for (const Violation& violation : verdict.violations) {
            if (violation.code != Code::vertex_went) continue;
            EXPECT_THAT(violation.expected, HasSubstr("it bisects the longest edge of a face"));
        }
        ++tried;
    }
    EXPECT_GT(tried, 5);
}

TEST(CoarseningFaults, CellsThatGoBackTwoStepsAreRefused) {
    History before{test::perturbed_kuhn(2, 0.2, 5), {}};
    for (const double radius : {1.0, 0.5}) {
        const auto present = reference::replay(before).back();
        before = refined(before, marked_cells(present, {.spheres = {{{0.5, 0.5, 1}, radius}}}),
                         Scheme::eight);
    }
    const Verdict once =
        verify_coarsening(before.input, test::cuts_of(before), {{.all = true}}, before.input);
    EXPECT_EQ(codes_of(once), "vertex_went too_many_generations");
    const Verdict twice = verify_coarsening(before.input, test::cuts_of(before),
                                            {{.all = true}, false, 2}, before.input);
    EXPECT_EQ(codes_of(twice), "");
}

/// Two cells that resemble halves of one, but are the input.
TEST(CoarseningFaults, CellsLargerThanThoseOfTheInputAreRefusedAtAnyLevel) {
    const auto& [a, b, c, d] = test::tie_free_corners;
    const Mesh input = test::mesh_of({a, b, c, d, midpoint(a, b)}, {{0, 4, 2, 3}, {4, 1, 2, 3}});
    const Verdict verdict =
        verify_coarsening(input, {}, {{.all = true}, false, 50}, test::one_cell({a, b, c, d}));
    EXPECT_EQ(codes_of(verdict), "lost_vertex too_many_generations");
}

TEST(CoarseningFaults, NothingIsRefusedUnlessNothingWasThere) {
    const Mesh input = test::one_cell(test::tie_free_corners);
    const History before = refined({input, {}}, CellMarks(1, 1), Scheme::eight);
    const CoarseningRequest all{{.all = true}};
    EXPECT_THAT(codes_of(verify_coarsening(input, test::cuts_of(before), all, {})),
                HasSubstr("lost_vertex"));
    EXPECT_THAT(codes_of(verify_coarsening(input, test::cuts_of(before), {}, {})),
                HasSubstr("vertex_went"));
    EXPECT_EQ(codes_of(verify_coarsening({}, {}, all, {})), "");
}

/// The midpoint of an edge that is not the longest of its faces: one half of the bisected cell
/// crosses cells of the previous mesh.
TEST(CoarseningFaults, CellsThatAreNoUnionsAreRefused) {
    const Mesh input = test::one_cell(test::tie_free_corners);
    const History before = refined({input, {}}, CellMarks(1, 1), Scheme::eight);
    int tried = 0;
    for (const EdgeVertices& edge : before.steps[0]) {
        const History after{input, {{edge}}};
        if (test::is_closed(input, {edge})) continue;
        const Verdict verdict = verify_coarsening(input, test::cuts_of(before), {{.all = true}},
                                                  mesh_of_history(after));
        EXPECT_THAT(codes_of(verdict), HasSubstr("vertex_stayed cell_not_before"));
        EXPECT_GT(verdict.count(Code::cell_not_before), 0U);
        ++tried;
    }
    EXPECT_EQ(tried, 5);
}

TEST(CoarseningFaults, VerticesThatTheMeshBeforeHasNotAreRefused) {
    const Mesh input = test::perturbed_kuhn(1, 0.2, 3);
    CellMarks first(6, 0);
    first[CellIndex{0}] = 1;
    const History before = refined({input, {}}, first, Scheme::two);
    const History other = refined({input, {}}, CellMarks(6, 1), Scheme::eight);
    const Verdict verdict =
        verify_coarsening(input, test::cuts_of(before), {{.all = true}}, mesh_of_history(other));
    EXPECT_EQ(codes_of(verdict), "vertex_not_before vertex_stayed");
    EXPECT_EQ(verdict.count(Code::vertex_not_before),
              other.steps[0].size() - before.steps[0].size());
}

/// A flat cell abcd is bisected at the three edges of its base abc, and two children again at the
/// line from a to the middle of bc. Without this last midpoint, which also lies between those of ab
/// and of ac, two cells that meet at the line between these overlap.
TEST(CoarseningFaults, AnotherPatternIsRefused) {
    const std::array<Point, 4> corners{{{0, 0, 0}, {48, -32, 0}, {44, 32, 0}, {31, 0, 2}}};
    const Mesh input = test::one_cell(corners);
    const auto find = [](const Mesh& mesh, const Point& p) {
        return static_cast<std::size_t>(std::ranges::find(mesh.points, p) - mesh.points.begin());
    };
    const auto vertex = [&](const Mesh& mesh, const Point& p) {
        return VertexIndex{find(mesh, p)};
    };
    const auto& [a, b, c, d] = corners;
    const Point ab = midpoint(a, b);
    const Point ac = midpoint(a, c);
    const Point bc = midpoint(b, c);
    ASSERT_EQ(midpoint(a, bc), midpoint(ab, ac));
    History once{input, {{}}};
    for (const auto& [p, q] : {std::array{a, b}, {a, c}, {b, c}}) {
        const auto [low, high] = std::minmax({vertex(input, p), vertex(input, q)});
        once.steps[0].push_back({low, high});
    }
    std::ranges::sort(once.steps[0]);
    ASSERT_TRUE(test::is_closed(input, once.steps[0]));
    const Mesh right = mesh_of_history(once);
    History twice = once;
    twice.steps.push_back({{vertex(right, a), vertex(right, bc)}});
    ASSERT_TRUE(test::is_closed(right, twice.steps[1]));

    std::vector<std::array<std::size_t, 4>> cells;
    for (const auto& points :
         {std::array{a, ab, ac, d}, {ab, bc, ac, d}, {ab, b, bc, d}, {bc, c, ac, d}}) {
        std::array<std::size_t, 4> cell;
        for (std::size_t k = 0; k < 4; ++k) cell[k] = find(right, points[k]);
        cells.push_back(cell);
    }
    const Mesh wrong = test::mesh_of({right.points.begin(), right.points.end()}, cells);

    // Cells of less than a quarter of the volume are marked, also at the second level, where there
    // are none.
    CoarseningRequest request{{.max_volume = octetra::volume({a, b, c, d}) / 4.5}, true, 2};
    const StepCuts cuts = test::cuts_of(twice);
    EXPECT_EQ(codes_of(verify_coarsening(input, cuts, request, right)), "");
    EXPECT_EQ(codes_of(verify_coarsening(input, cuts, request, wrong)), "not_tiled wrong_pattern");
    request.levels = 1;
    EXPECT_EQ(codes_of(verify_coarsening(input, cuts, request, right)), "");
    EXPECT_EQ(codes_of(verify_coarsening(input, cuts, request, wrong)),
              "not_tiled too_many_generations");
}

/// The first violation with this code.
Violation violation_of(const Verdict& verdict, Code code) {
    for (const Violation& violation : verdict.violations) {
        if (violation.code == code) return violation;
    }
    ADD_FAILURE() << "no " << name(code);
    return {.entities = {Entity{}}};
}

TEST(CoarseningFaults, AreExplainedByTheRule) {
    const Mesh input = test::one_cell(test::tie_free_corners);
    const History once = refined({input, {}}, CellMarks(1, 1), Scheme::two);  // two cells
    const History before = refined(once, {1, 0}, Scheme::two);
    const auto expected = [&](const CoarseningRequest& request) {
        const Verdict verdict = verify_coarsening(input, test::cuts_of(before), request, input);
        EXPECT_EQ(verdict.count(Code::vertex_went), 1U + (request.may_coarsen.all ? 0U : 1U));
        const Violation violation = violation_of(verdict, Code::vertex_went);
        EXPECT_EQ(violation.entities.front().mesh, Which::before);
        EXPECT_EQ(violation.entities.front().number, 4U);
        return violation.expected;
    };
    EXPECT_EQ(expected({}), "kept: it belongs to this cell, which must not be coarsened");
    EXPECT_EQ(expected({{.all = true}}),
              "kept: this cell contains it and a vertex of a later step");
    EXPECT_EQ(expected({{}, true, 0}), "kept: no level could remove it");
}

}  // namespace
}  // namespace octetra::verify
