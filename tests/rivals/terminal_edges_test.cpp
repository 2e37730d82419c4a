#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "rivals/slow_terminal_edges.hpp"
#include "rivals/terminal_edges.hpp"
#include "support/conformity.hpp"
#include "support/meshes.hpp"
#include "support/tagged_meshes.hpp"

/// The result follows the definition of the method for any order of bisections and any numbering;
/// it is a refinement, and no unnecessary edge is bisected.
namespace octetra::rivals {
namespace {

using test::SlowTerminalEdges;

struct Refined {
    TerminalEdgeMesh made;
    Rounds rounds;
};

Refined refined(const Mesh& mesh, const Goal& goal) {
    TerminalEdgeBisection bisection(mesh);
    Rounds rounds = bisection.refine(goal);
    return {bisection.result(), rounds};
}

double longest_of(const Corners& corners) {
    double square = 0;
    for (const auto& [i, j] : cell_edges) {
        square = std::max(square, squared_length({corners[i], corners[j]}));
    }
    return square;
}

SlowTerminalEdges::IsToBeCut in_words(const Goal& goal) {
    return [goal](const Corners& corners, CellIndex root, bool is_input) {
        if (!goal.targets.empty() && goal.targets[root.value()] == 0) return false;
        if (!goal.longest_edge && !goal.volume) return is_input;
        if (goal.volume && volume(corners) > *goal.volume) return true;
        return goal.longest_edge && longest_of(corners) > *goal.longest_edge * *goal.longest_edge;
    };
}

/// Once, to smaller volumes, to shorter edges, or both; for all cells, or for some.
std::vector<Goal> goals_of(const Mesh& mesh, double part, std::uint64_t seed) {
    double square = 0;
    double largest = 0;
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const Corners corners = test::corners_of(mesh, c);
        square = std::max(square, longest_of(corners));
        largest = std::max(largest, volume(corners));
    }
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> some(mesh.cells.size());
    for (auto& target : some) target = random() % 5 == 0 ? 1 : 0;
    some.front() = 1;
    std::vector<Goal> goals;
    for (const std::vector<std::uint8_t>& targets : {std::vector<std::uint8_t>{}, some}) {
        goals.push_back({.targets = targets});
        goals.push_back({.targets = targets, .longest_edge = part * std::sqrt(square)});
        goals.push_back({.targets = targets, .volume = part * part * part * largest});
    }
    goals.push_back({.longest_edge = 0.8 * std::sqrt(square), .volume = 0.2 * largest});
    return goals;
}

void expect_conforms(const Mesh& mesh) { EXPECT_EQ(test::count_faces(mesh).faults, 0U); }

void expect_same_as_words(const Mesh& mesh, const Goal& goal, std::uint64_t seed) {
    const Refined fast = refined(mesh, goal);
    SlowTerminalEdges rounds(mesh, in_words(goal));
    EXPECT_EQ(fast.rounds.edges_bisected, rounds.in_rounds());
    EXPECT_EQ(fast.rounds.cells_cut, fast.made.mesh.cells.size() - mesh.cells.size());
    EXPECT_TRUE(test::geometry(fast.made.mesh) == test::geometry(rounds.mesh()));
    SlowTerminalEdges singly(mesh, in_words(goal));
    singly.one_by_one(seed);
    EXPECT_TRUE(test::geometry(fast.made.mesh) == test::geometry(singly.mesh()));
    expect_conforms(fast.made.mesh);
}

std::vector<Mesh> small_meshes(std::uint64_t seed) {
    std::vector<Mesh> meshes{test::kuhn(1, 1, 1),
                             test::kuhn(2, 1, 2),
                             test::perturbed_kuhn(2, 0.3, seed),
                             test::shell(12, seed),
                             test::one_cell(test::regular_corners),
                             test::one_cell(test::cube_corner)};
    for (Mesh& mesh : meshes) {
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            mesh.regions.append(static_cast<Marker>(c.value() % 3));
        }
    }
    return meshes;
}

class TerminalEdges : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TerminalEdges, AreBisectedInTheRoundsAndToTheMeshOfTheDefinition) {
    for (const Mesh& mesh : small_meshes(GetParam())) {
        for (const Goal& goal : goals_of(mesh, 0.45, GetParam())) {
            expect_same_as_words(mesh, goal, GetParam());
        }
    }
}

TEST_P(TerminalEdges, DoNotDependOnNumbers) {
    const std::uint64_t seed = GetParam();
    for (const Mesh& mesh :
         {test::kuhn(3, 3, 3), test::perturbed_kuhn(3, 0.3, seed),
          test::one_cell(test::regular_corners), test::one_cell(test::sommerville_corners)}) {
        const Mesh tagged = test::tagged(mesh);
        const Mesh other = test::renumbered(tagged, seed);
        const auto targets = [](const Mesh& of) {
            std::vector<std::uint8_t> of_region_1;
            for (const Marker region : of.regions) of_region_1.push_back(region == 1 ? 1 : 0);
            return of_region_1;
        };
        for (Goal goal : goals_of(mesh, 0.3, seed)) {
            const bool everywhere = goal.targets.empty();
            if (!everywhere) goal.targets = targets(tagged);
            const Refined one = refined(tagged, goal);
            if (!everywhere) goal.targets = targets(other);
            const Refined two = refined(other, goal);
            EXPECT_EQ(one.rounds.edges_bisected, two.rounds.edges_bisected);
            EXPECT_TRUE(test::geometry(one.made.mesh) == test::geometry(two.made.mesh));
        }
    }
}

TEST_P(TerminalEdges, MayBeBisectedTowardsOneGoalAfterTheOther) {
    const Mesh mesh = test::perturbed_kuhn(3, 0.3, GetParam());
    TerminalEdgeBisection bisection(mesh);
    for (const double volume : {0.1, 0.02, 0.004}) (void)bisection.refine({.volume = volume});
    EXPECT_TRUE(test::geometry(bisection.result().mesh) ==
                test::geometry(refined(mesh, {.volume = 0.004}).made.mesh));
    EXPECT_TRUE(bisection.refine({.volume = 0.004}).edges_bisected.empty());
}

INSTANTIATE_TEST_SUITE_P(Seeds, TerminalEdges, testing::Range<std::uint64_t>(0, 4));

/// Cells with integer coordinates, one for each of the 720 orders of edges.
std::map<std::array<std::size_t, 6>, Mesh> cells_of_all_orders() {
    std::map<std::array<std::size_t, 6>, Mesh> cells;
    std::mt19937_64 random(1);
    while (cells.size() < 720) {
        std::array<Point, 4> corners = test::regular_corners;
        for (Point& p : corners) {
            for (double Point::*x : {&Point::x, &Point::y, &Point::z}) {
                p.*x = 64 * p.*x + static_cast<double>(random() % 33) - 16;
            }
        }
        std::array<std::size_t, 6> order;
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto segment = [&](std::size_t k) {
            const auto& [i, j] = cell_edges[k];
            return Segment{corners[i], corners[j]};
        };
        std::ranges::sort(
            order, [&](std::size_t e, std::size_t f) { return longer(segment(e), segment(f)); });
        cells.try_emplace(order, test::one_cell(corners));
    }
    return cells;
}

/// The volumes of the children of each cell, as integers, sum to that of the cell.
void expect_same_volume(const Mesh& fine, const Mesh& coarse, double scale) {
    const auto sum = [&](const Mesh& mesh) {
        test::Int128 volume = 0;
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            const auto cell = test::exact_volume(test::corners_of(mesh, c), scale);
            EXPECT_GT(cell, 0);
            volume += cell;
        }
        return volume;
    };
    EXPECT_TRUE(sum(fine) == sum(coarse));
}

TEST(OneCell, OfAnyOrderOfItsEdgesIsBisectedByDefinition) {
    for (const auto& [order, mesh] : cells_of_all_orders()) {
        const double whole = volume(test::corners_of(mesh, CellIndex{0}));
        for (const Goal& goal : {Goal{}, Goal{.volume = whole / 8}, Goal{.longest_edge = 130}}) {
            const Refined fast = refined(mesh, goal);
            SlowTerminalEdges slow(mesh, in_words(goal));
            ASSERT_EQ(fast.rounds.edges_bisected, slow.in_rounds());
            ASSERT_TRUE(test::geometry(fast.made.mesh) == test::geometry(slow.mesh()));
            ASSERT_EQ(test::count_faces(fast.made.mesh).faults, 0U);
            expect_same_volume(fast.made.mesh, mesh, 0x1p10);
        }
    }
}

TEST(Lattice, KeepsItsVolumeExactlyAndItsRegionsAndOrder) {
    Mesh mesh = test::kuhn(3, 2, 2);
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        mesh.regions.append(static_cast<Marker>(c.value() % 4));
    }
    const TerminalEdgeMesh made = refined(mesh, {.volume = 0x1p-8}).made;
    expect_same_volume(made.mesh, mesh, 0x1p10);
    EXPECT_TRUE(std::ranges::is_sorted(made.maps.cell_to_parent));
    for (CellIndex c{0}; c < made.mesh.cells.end_index(); ++c) {
        EXPECT_EQ(made.mesh.regions[c], mesh.regions[made.maps.cell_to_parent[c]]);
        EXPECT_LE(volume(test::corners_of(made.mesh, c)), 0x1p-8);
    }
}

/// Checks the descendants of a cell: itself, or recursively the halves at its longest edge; `at` is
/// the index of the next cell of the result.
void expect_halves(const Mesh& fine, const Corners& cell, CellIndex& at) {
    ASSERT_LT(at, fine.cells.end_index());
    if (test::corners_of(fine, at) == cell) {
        ++at;
        return;
    }
    std::size_t longest = 0;
    const auto segment = [&](std::size_t k) {
        return Segment{cell[cell_edges[k][0]], cell[cell_edges[k][1]]};
    };
    for (std::size_t k = 1; k < 6; ++k) {
        if (longer(segment(k), segment(longest))) longest = k;
    }
    ASSERT_GT(volume(cell), 0x1p-20);
    const auto& [first, second] = cell_edges[longest];
    Corners half = cell;
    half[second] = midpoint(cell[first], cell[second]);
    expect_halves(fine, half, at);
    if (testing::Test::HasFatalFailure()) return;
    half = cell;
    half[first] = midpoint(cell[first], cell[second]);
    expect_halves(fine, half, at);
}

/// Midpoints are sorted by level, and within a level by the ends of their edges.
void expect_levels(const RefinementMaps& maps) {
    std::vector<std::pair<std::size_t, EdgeVertices>> keys;
    const auto level = [&](VertexIndex v) {
        return v < maps.first_midpoint ? 0 : keys[v.value() - maps.first_midpoint.value()].first;
    };
    for (const EdgeVertices& edge : maps.midpoint_to_edge) {
        EXPECT_LT(edge[0], edge[1]);
        ASSERT_LT(edge[1].value(), maps.first_midpoint.value() + keys.size());
        keys.emplace_back(1 + std::max(level(edge[0]), level(edge[1])), edge);
    }
    EXPECT_TRUE(std::ranges::is_sorted(keys));
    EXPECT_GT(keys.back().first, 1U);
}

TEST(Order, IsThatOfHalvesAndOfLevelsOfMidpoints) {
    for (const Mesh& mesh : {test::kuhn(2, 3, 2), test::perturbed_kuhn(3, 0.3, 5)}) {
        const Refined fine = refined(mesh, {.volume = 0.01});
        CellIndex at{0};
        for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
            expect_halves(fine.made.mesh, test::corners_of(mesh, c), at);
        }
        EXPECT_EQ(at, fine.made.mesh.cells.end_index());
        expect_levels(fine.made.maps);
    }
}

/// Every cell has an edge of its own that only longer edges precede, up to the largest cell's.
TEST(Shell, IsCutFromItsEndInAsManyRoundsAsItHasCells) {
    constexpr std::size_t count = 40;
    Goal goal;
    goal.targets.assign(count, 0);
    goal.targets.front() = 1;
    const Refined made = refined(test::shell(count, 3), goal);
    EXPECT_EQ(made.rounds.edges_bisected.size(), count);
    EXPECT_TRUE(std::ranges::all_of(made.rounds.edges_bisected, [](auto n) { return n < 3; }));
}

}  // namespace
}  // namespace octetra::rivals
