#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octetra/quality/shape.hpp>
#include <octetra/reference/history.hpp>

#include "bisect.hpp"
#include "reference/random_history.hpp"
#include "support/conformity.hpp"
#include "support/refinement.hpp"

/// Refinement with Closure::regular.
namespace octetra::reference {
namespace {

/// A mesh after each of `steps` steps that mark about `count` cells.
struct RandomSteps {
    std::vector<History> histories;
    std::vector<CellMarks> marks;  ///< of each step

    RandomSteps(const Mesh& input, double count, int steps, std::uint64_t seed)
        : histories{{input, {}}} {
        std::mt19937_64 random(seed);
        for (int k = 0; k < steps; ++k) {
            const Refinement present = replay(histories.back()).back();
            marks.push_back(marked_cells(present, about(count, present.mesh, random())));
            histories.push_back(refined_regularly(histories.back(), marks.back()));
        }
    }
};

Mesh mesh_of(const History& history) { return replay(history).back().mesh; }

class Regular : public testing::TestWithParam<std::uint64_t> {
protected:
    const RandomSteps random{random_input(GetParam()), 2, 5, GetParam()};
};

TEST_P(Regular, StepsAreClosedAndConformingAndMakeMarkedCellsSmaller) {
    for (std::size_t k = 0; k < random.marks.size(); ++k) {
        const auto meshes = replay(random.histories[k + 1]);
        const std::size_t boundary = test::count_faces(random.histories[0].input).boundary_faces;
        const auto census = test::count_faces(meshes.back().mesh);
        EXPECT_EQ(census.faults, 0U);
        EXPECT_GE(census.boundary_faces, boundary);
        std::set<Corners> after;
        for (const auto& [corners, region] : test::geometry(meshes.back().mesh)) {
            after.insert(corners);
        }
        const auto before = mesh_of(random.histories[k]);
        for (CellIndex c{0}; c < before.cells.end_index(); ++c) {
            if (random.marks[k][c] == 0) continue;
            Corners corners = test::corners_of(before, c);
            std::ranges::sort(corners);
            EXPECT_FALSE(after.contains(corners));
        }
    }
}

constexpr int transition = -1;

/// Expects that each step bisects regular cells of its generation only.
void expect_regular(const History& history) {
    const auto meshes = replay(history);
    std::vector<int> generations(history.input.cells.size(), 0);
    for (std::size_t t = 0; t < history.steps.size(); ++t) {
        const Mesh& mesh = meshes[t].mesh;
        const EdgeTable table = number_edges(mesh);
        const EdgeToMidpoint midpoints = midpoints_of(history.steps[t], table, mesh);
        std::vector<int> after;
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            const auto count = std::ranges::count_if(
                table.cell_to_edges[c], [&](EdgeIndex e) { return !midpoints[e].is_none(); });
            const int generation = generations[c.value()];
            if (count > 0) {
                EXPECT_EQ(generation, static_cast<int>(t));
            }
            const int children =
                count == 0 ? generation : (count == 6 ? generation + 1 : transition);
            after.insert(after.end(), pieces_of(mesh.cells[c], mesh, table, midpoints).size(),
                         children);
        }
        generations = after;
    }
}

TEST_P(Regular, StepsBisectRegularCellsOfTheirGenerationOnly) {
    for (const History& history : random.histories) expect_regular(history);
}

/// Rule (c) of coarsened() matters: without it, some of these histories are not regular.
TEST_P(Regular, CoarseningLeavesRegularAndTransitionCells) {
    std::mt19937_64 random_number(GetParam());
    for (const History& history : random.histories) {
        History coarser = history;
        for (int k = 0; k < 3; ++k) {
            const Refinement present = replay(coarser).back();
            const Selection most = about(0.8 * static_cast<double>(present.mesh.cells.size()),
                                         present.mesh, random_number());
            coarser = coarsened(coarser, marked_cells(present, most), Closure::regular);
            expect_regular(coarser);
        }
    }
}

/// Returns the marks of those of the cells that the mesh has.
CellMarks marks_of(const History& history, const std::vector<Corners>& cells) {
    const Mesh mesh = mesh_of(history);
    CellMarks marks(mesh.cells.size(), false);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        marks[c] = std::ranges::find(cells, test::corners_of(mesh, c)) != cells.end();
    }
    return marks;
}

TEST_P(Regular, ResultDoesNotDependOnTheOrderOfMarks) {
    const History& history = random.histories[3];
    const Mesh mesh = mesh_of(history);
    int compared = 0;
    for (std::size_t k = 0; k < 12; ++k) {
        const auto cell = [&](std::size_t number) {
            return test::corners_of(mesh, CellIndex{number % mesh.cells.size()});
        };
        const std::array chosen{cell(GetParam() + 7 * k), cell(GetParam() + 11 * k + 3)};
        std::array<History, 2> one;
        for (std::size_t i : {0U, 1U}) {
            one[i] = refined_regularly(history, marks_of(history, {chosen[i]}));
        }
        const History both = refined_regularly(history, marks_of(history, {chosen[0], chosen[1]}));
        for (std::size_t i : {0U, 1U}) {
            const CellMarks rest = marks_of(one[i], {chosen[1 - i]});
            if (std::ranges::find(rest, true) == rest.end()) continue;  // it was bisected already
            EXPECT_TRUE(refined_regularly(one[i], rest) == both);
            ++compared;
        }
    }
    EXPECT_GT(compared, 4);
}

/// The prototype of the rules gave these bounds for any number of steps.
TEST(RegularRefinement, KeepsTheAnglesOfALatticeUnlikePlainClosure) {
    const Mesh lattice = test::kuhn(2, 2, 2);
    const auto range = [](const Mesh& mesh) {
        std::pair<double, double> angles{180, 0};
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            for (const double angle : quality::dihedral_angles(test::corners_of(mesh, c))) {
                angles = {std::min(angles.first, angle), std::max(angles.second, angle)};
            }
        }
        return angles;
    };
    History plain{lattice, {}};
    History regular{lattice, {}};
    for (std::uint64_t k = 0; k < 7; ++k) {
        const Selection some{.random = RandomShare{0.03, k}};
        plain = refined(plain, marked_cells(replay(plain).back(), some), Scheme::eight);
        regular = refined_regularly(regular, marked_cells(replay(regular).back(), some));
    }
    const auto [least, greatest] = range(mesh_of(regular));
    EXPECT_NEAR(least, 45, 1e-9);
    EXPECT_LT(greatest, 120 + 1e-9);
    EXPECT_LT(range(mesh_of(plain)).first, 30);
}

/// With every cell marked, both closures bisect all edges.
TEST(RegularRefinement, OfAllCellsIsPlainRefinement) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Mesh mesh = random_input(seed);
        const Selection all{.all = true};
        EXPECT_EQ(refine_regularly(mesh, all, 2).mesh, refine(mesh, all, Scheme::eight, 2).mesh);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Regular, testing::Range<std::uint64_t>(0, 6));

}  // namespace
}  // namespace octetra::reference
