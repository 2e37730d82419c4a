#include <cstdlib>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "properties/coarsened_worlds.hpp"
#include "properties/glued_cells.hpp"
#include "properties/small_worlds.hpp"
#include "properties/team.hpp"
#include "support/meshes.hpp"

/// The smallest meshes, refined and coarsened, in every order of their edges by length.
namespace octetra::properties {
namespace {

using reference::CellMarks;
using reference::History;

/// Strides: every n-th world of a kind is tested.
struct Steps {
    std::size_t every_day = 1;  ///< default run and nightly run; greater under sanitizers
    std::size_t campaign = 1;   ///< for ./dev campaign worlds, which sets OCTETRA_COARSENED_WORLDS
};

void for_worlds(const WorldKind& kind, const Steps& steps,
                const std::function<void(const Mesh&, Draw&)>& hold) {
    const bool is_campaign = std::getenv("OCTETRA_COARSENED_WORLDS") != nullptr;
    const std::size_t step =
        is_campaign ? steps.campaign : steps.every_day * OCTETRA_SMALL_WORLDS_STRIDE;
    for (std::size_t i = 0; i < count_worlds(kind) && !testing::Test::HasFailure(); i += step) {
        SCOPED_TRACE(kind.name + ", world " + std::to_string(i));
        Mesh world = world_of(kind, i);
        test::list_boundary(world);
        Draw draw(i);
        hold(world, draw);
    }
}

/// The bit of an edge of the only cell.
EdgeBits bit_of(const EdgeVertices& edge, const Mesh& cell) {
    EdgeBits bits = 0;
    for (std::size_t e = 0; e < 6; ++e) {
        const VertexIndex a = cell.cells.front()[cell_edges[e][0]];
        const VertexIndex b = cell.cells.front()[cell_edges[e][1]];
        if (edge == EdgeVertices{std::min(a, b), std::max(a, b)}) bits |= 1U << e;
    }
    return bits;
}

/// For each child of the only cell, the edges whose midpoints it has.
std::vector<EdgeBits> midpoints_of_children(const History& history) {
    std::vector<EdgeBits> result;
    const auto meshes = replay(history);
    for (const CellVertices& child : meshes.back().mesh.cells) {
        EdgeBits bits = 0;
        for (const VertexIndex v : child) {
            if (v < history.input.points.end_index()) continue;
            const std::size_t number = v.value() - history.input.points.size();
            bits |= bit_of(history.steps.front()[number], history.input);
        }
        result.push_back(bits);
    }
    return result;
}

/// For every set of children, the remaining edges are the closure of those required by the other
/// children. Each set of remaining edges is judged once.
void hold_for_all_children(const History& history) {
    const Order order = order_of(history.input, CellIndex{0});
    const auto midpoints = midpoints_of_children(history);
    std::set<EdgeBits> judged;
    for (unsigned chosen = 0; chosen < 1U << midpoints.size(); ++chosen) {
        CellMarks may_coarsen;
        EdgeBits needed = 0;
        for (std::size_t child = 0; child < midpoints.size(); ++child) {
            may_coarsen.append(static_cast<char>(chosen >> child & 1U));
            if ((chosen >> child & 1U) == 0) needed |= midpoints[child];
        }
        EdgeBits left = 0;
        for (const auto& step : coarsened(history, may_coarsen).steps) {
            for (const EdgeVertices& edge : step) left |= bit_of(edge, history.input);
        }
        ASSERT_EQ(left, closed_in_cell(order, needed));
        if (!judged.insert(left).second) continue;
        ASSERT_EQ(fault_of_coarsening(history, may_coarsen), "");
    }
}

TEST(CoarsenedWorlds, OfOneCellInEveryOrderAndEveryPatternForEverySetOfItsChildren) {
    run_on_first_rank([] {
        for_worlds(one_cell(), {}, [](const Mesh& world, Draw&) {
            for (const History& history : histories_of_one_step(world)) {
                hold_for_all_children(history);
            }
        });
    });
}

/// Neighbours may keep any edges of a cell, so more sets occur than its own children can cause.
TEST(CoarsenedWorlds, OfOneCellInEveryOrderAreNestedWhateverClosedSetIsLeftOfAnother) {
    run_on_first_rank([] {
        for_worlds(one_cell(), {}, [](const Mesh& world, Draw&) {
            const auto patterns = histories_of_one_step(world);
            for (const History& more : patterns) {
                ASSERT_EQ(fault_of_fewer_edges(more, {world, {}}), "");
                for (const History& fewer : patterns) {
                    if (!std::ranges::includes(more.steps.front(), fewer.steps.front())) continue;
                    ASSERT_EQ(fault_of_fewer_edges(more, fewer), "");
                }
            }
        });
    });
}

/// Coarsens random cells, `times` times in succession.
void coarsen_at_random(History history, std::size_t times, Draw& draw) {
    for (std::size_t i = 0; i < times; ++i) {
        const CellMarks may_coarsen = random_marks(history, draw);
        ASSERT_EQ(fault_of_coarsening(history, may_coarsen), "");
        history = coarsened(history, may_coarsen);
    }
}

TEST(CoarsenedWorlds, OfOneCellInEveryOrderAndEveryPatternRefinedOnceMore) {
    run_on_first_rank([] {
        for_worlds(one_cell(), {.every_day = 7}, [](const Mesh& world, Draw& draw) {
            for (const History& history : histories_of_one_step(world)) {
                coarsen_at_random(refined_at_random(history, draw), 3, draw);
            }
        });
    });
}

/// Refines the world at random two or three times, then coarsens it three times.
void hold_at_random(const Mesh& world, Draw& draw) {
    History history{world, {}};
    const int steps = draw.between(2, 3);
    for (int step = 0; step < steps; ++step) history = refined_at_random(history, draw);
    coarsen_at_random(history, 3, draw);
}

TEST(CoarsenedWorlds, OfTwoCellsAtAFaceRefinedAtRandom) {
    run_on_first_rank([] { for_worlds(two_cells_at_a_face(), {.every_day = 37}, hold_at_random); });
}

TEST(CoarsenedWorlds, OfTwoCellsAtAnEdgeRefinedAtRandom) {
    run_on_first_rank(
        [] { for_worlds(two_cells_at_an_edge(), {.every_day = 167}, hold_at_random); });
}

TEST(CoarsenedWorlds, OfThreeCellsInARowRefinedAtRandom) {
    run_on_first_rank([] {
        for_worlds(three_cells_in_a_row(), {.every_day = 11'731, .campaign = 577}, hold_at_random);
    });
}

}  // namespace
}  // namespace octetra::properties
