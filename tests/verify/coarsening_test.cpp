#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/error.hpp>

#include "coarsening/kept_vertices.hpp"
#include "coarsening/lineage.hpp"
#include "reference/random_history.hpp"
#include "support/coarsening.hpp"
#include "support/thrown.hpp"
#include "verify/coarsening.hpp"
#include "verify/verdicts.hpp"

/// Meshes coarsened according to the rules pass. Refusals are in coarsening_faults_test.cpp.
namespace octetra::verify {
namespace {

using reference::Call;
using reference::CellMarks;
using reference::History;
using reference::refined;
using test::codes_of;
using test::mesh_of_history;
using test::request_of;

std::string judged(const Call& call) {
    return codes_of(verify_coarsening(call.before.input, test::cuts_of(call.before),
                                      request_of(call.marked), mesh_of_history(call.after)));
}

class Coarsening : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Coarsening, ByTheReferenceIsValid) {
    for (const Call& call : reference::random_coarsenings(GetParam())) {
        EXPECT_EQ(judged(call), "");
    }
}

TEST_P(Coarsening, OfStepsThatAreRepeatedMakesTheMeshAndItsCells) {
    for (const Call& call : reference::random_coarsenings(GetParam())) {
        const Mesh expected = mesh_of_history(call.before);
        const Lineage lineage = lineage_of(call.before.input, test::cuts_of(call.before));
        EXPECT_EQ(lineage.points, expected.points);
        IndexVector<CellIndex, CellVertices> cells;
        for (const PresentCell& cell : lineage.cells.present) cells.append(cell.vertices);
        EXPECT_EQ(cells, expected.cells);
        const std::vector<int> steps = test::steps_of_vertices(call.before);
        EXPECT_TRUE(std::ranges::equal(lineage.step, steps));
    }
}

/// The rules refer to the meshes before the steps; their evaluation on the present cells must keep
/// the same vertices.
TEST_P(Coarsening, KeepsTheSameVerticesByPresentCellsAsByThoseBeforeEachStep) {
    for (const Call& call : reference::random_coarsenings(GetParam())) {
        const Lineage lineage = lineage_of(call.before.input, test::cuts_of(call.before));
        const Reasons reasons =
            keep_reasons(lineage, lineage.cells, {call.marked.begin(), call.marked.end()},
                         Closure::longest_edge);
        std::set<Point> by_cells;
        std::set<Point> all;
        for (VertexIndex v{0}; v < reasons.end_index(); ++v) {
            if (reasons[v].why == Reason::Why::none) continue;
            all.insert(lineage.points[v]);
            if (reasons[v].why != Reason::Why::closure) by_cells.insert(lineage.points[v]);
        }
        const test::RequiredPoints required = test::points_that_stay(call.before, call.marked);
        EXPECT_EQ(by_cells, required.by_cells);
        EXPECT_EQ(all, required.all);
    }
}

TEST_P(Coarsening, IsMatchedByCoordinatesAfterRenumbering) {
    for (Call call : reference::random_coarsenings(GetParam())) {
        call.before.input.attributes_per_point = 0;  // renumbered() does not permute them
        call.before.input.point_attributes.clear();
        const Mesh after = mesh_of_history(coarsened(call.before, call.marked));
        const Verdict verdict =
            verify_coarsening(call.before.input, test::cuts_of(call.before),
                              request_of(call.marked), test::renumbered(after, GetParam()));
        EXPECT_EQ(codes_of(verdict), "");
    }
}

/// Repeated as often as requested, with criteria evaluated anew on each coarser mesh.
TEST_P(Coarsening, OfSeveralLevelsIsValidWithSoManyAndNotWithFewer) {
    std::mt19937_64 random(GetParam());
    for (const Call& call : reference::random_coarsenings(GetParam())) {
        const Mesh present = mesh_of_history(call.before);
        const bool outside = random() % 2 == 0;
        Selection selection = reference::random_cells_to_coarsen(present, random);
        const StepCuts cuts = test::cuts_of(call.before);
        std::vector<History> by_levels{call.before};
        for (int level = 0; level < 3; ++level) {
            CellMarks marked = marked_cells(reference::replay(by_levels.back()).back(), selection);
            for (char& mark : marked) mark = (mark != 0) != outside ? 1 : 0;
            by_levels.push_back(coarsened(by_levels.back(), marked));
        }
        for (int asked = 0; asked <= 3; ++asked) {
            for (std::size_t done = 0; done <= 3; ++done) {
                const Verdict verdict =
                    verify_coarsening(call.before.input, cuts, {selection, outside, asked},
                                      mesh_of_history(by_levels[done]));
                EXPECT_EQ(verdict.valid(),
                          by_levels[done] == by_levels[static_cast<std::size_t>(asked)])
                    << asked << " asked, " << done << " done: " << codes_of(verdict);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Coarsening, testing::Range<std::uint64_t>(0, 12));

/// Judges all possible coarsened meshes of a small mesh with all possible marks.
void expect_right_ones_alone(const History& before) {
    const std::size_t cells = mesh_of_history(before).cells.size();
    ASSERT_LE(cells, 10U);
    const StepCuts cuts = test::cuts_of(before);
    std::map<std::vector<std::vector<EdgeVertices>>, Mesh> results;
    std::vector<std::pair<CellMarks, History>> by_marks;
    for (std::size_t set = 0; set < std::size_t{1} << cells; ++set) {
        CellMarks marked;
        for (std::size_t c = 0; c < cells; ++c) marked.append((set >> c & 1U) != 0 ? 1 : 0);
        by_marks.emplace_back(marked, coarsened(before, marked));
        results.try_emplace(by_marks.back().second.steps, mesh_of_history(by_marks.back().second));
    }
    EXPECT_GT(results.size(), 2U);
    for (const auto& [marked, right] : by_marks) {
        for (const auto& [steps, mesh] : results) {
            const Verdict verdict =
                verify_coarsening(before.input, cuts, request_of(marked), mesh, {.fast = true});
            EXPECT_EQ(verdict.valid(), steps == right.steps) << codes_of(verdict);
        }
    }
}

TEST(CoarseningOfSmallMeshes, IsValidExactlyIfItEqualsTheReference) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        History history{test::shell(2, seed), {}};
        while (mesh_of_history(history).cells.size() < 6) {
            const auto present = reference::replay(history).back();
            const auto marks = marked_cells(present, reference::about(1, present.mesh, random()));
            const History finer = refined(history, marks, Scheme::two);
            if (mesh_of_history(finer).cells.size() <= 9) history = finer;
        }
        expect_right_ones_alone(history);
    }
}

/// Midpoints of opposite edges are joined, but the edges lie in no common face: neither midpoint
/// requires the other.
TEST(CoarseningOfSmallMeshes, RemovesTheMidpointOfAnOppositeEdgeAlone) {
    // Two cells at a face. The longest edge of the first is opposite that of the second.
    const Mesh input =
        test::mesh_of({{-0.25, 0, 0}, {2, 0, 0}, {1, 1, 1}, {1, 1, -1}, {2.5, 1.5, 0}},
                      {{0, 1, 2, 3}, {1, 2, 3, 4}});
    const History before = refined({input, {}}, CellMarks(2, 1), Scheme::two);
    ASSERT_EQ(before.steps[0], (std::vector<EdgeVertices>{{VertexIndex{0}, VertexIndex{1}},
                                                          {VertexIndex{2}, VertexIndex{3}}}));
    expect_right_ones_alone(before);
}

Mesh with_last_two_exchanged(Mesh mesh) {
    const VertexIndex last{mesh.points.size() - 1};
    const VertexIndex other{mesh.points.size() - 2};
    std::swap(mesh.points[last], mesh.points[other]);
    for (CellVertices& cell : mesh.cells) {
        for (VertexIndex& v : cell) v = v == last ? other : v == other ? last : v;
    }
    return mesh;
}

/// Coincident vertices are distinguished by their numbers; or, after renumbering, those that stay
/// are matched first.
TEST(CoarseningAtACrack, OfOneSideIsValid) {
    const Mesh input = test::mesh_of(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const History before = refined({input, {}}, CellMarks(2, 1), Scheme::eight);
    const reference::Refinement present = reference::replay(before).back();
    for (const bool first : {true, false}) {
        CellMarks may_coarsen;
        for (const CellIndex root : present.maps.cell_to_parent) {
            may_coarsen.append((root == CellIndex{0}) == first ? 1 : 0);
        }
        const Mesh after = mesh_of_history(coarsened(before, may_coarsen));
        ASSERT_EQ(after.cells.size(), 9U);
        for (const bool asked_first : {true, false}) {
            const CoarseningRequest request{{.boxes = {{{0, 0, 0}, {1, 1, 1}}}}, !asked_first};
            for (const Mesh& mesh : {after, with_last_two_exchanged(after)}) {
                const Verdict verdict =
                    verify_coarsening(input, test::cuts_of(before), request, mesh);
                EXPECT_EQ(verdict.valid(), first == asked_first) << codes_of(verdict);
            }
        }
    }
}

TEST(CoarseningOfStepsThatFitNoMesh, IsNotJudged) {
    const Mesh input = test::kuhn(1, 1, 1);
    const History before = refined({input, {}}, CellMarks(6, 1), Scheme::eight);
    const Mesh after = mesh_of_history(before);
    const StepCuts right = test::cuts_of(before);
    const auto refusal = [&](const StepCuts& cuts, const CoarseningRequest& request = {}) {
        return test::thrown_by<InputError>(
            [&] { (void)verify_coarsening(input, cuts, request, after); });
    };
    StepCuts cuts = right;
    cuts[0].pop_back();
    EXPECT_EQ(refusal(cuts),
              "step 1 does not fit the mesh before it: it has data of 5 cells, but there are 6");
    cuts = right;
    cuts.push_back(std::vector<std::uint8_t>(after.cells.size(), 0));
    cuts[1][7] = 0x3f;
    EXPECT_THAT(refusal(cuts),
                testing::MatchesRegex("step 2 does not fit the mesh before it: cell .*, "
                                      "from 0, and a neighbour disagree on an edge"));
    cuts = right;
    for (CellIndex c{0}; c < input.cells.end_index(); ++c) {
        for (std::size_t k = 0; k < cell_edges.size(); ++k) {
            const auto [i, j] = cell_edges[k];  // of the longest edge of all, from corner to corner
            const auto [low, high] = std::minmax(input.cells[c][i], input.cells[c][j]);
            if (low == VertexIndex{0} && high == VertexIndex{7}) {
                cuts[0][c.value()] &= static_cast<std::uint8_t>(~(1U << k));
            }
        }
    }
    EXPECT_EQ(refusal(cuts),
              "step 1 does not fit the mesh before it: on a face of cell 0, from 0, it bisects an "
              "edge but not the longest");
    EXPECT_EQ(refusal(right, {{.cells = {GlobalCell{48}}}}),
              "cell 48 is listed, from 0, but the mesh before has 48");
    EXPECT_EQ(refusal(right, {{.cells = {GlobalCell{4}}}, false, 2}),
              "a list of cells allows only one level");
}

}  // namespace
}  // namespace octetra::verify
