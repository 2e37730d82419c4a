#include <algorithm>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "distributed/world.hpp"
#include "properties/judge.hpp"
#include "properties/report.hpp"
#include "properties/small_worlds.hpp"
#include "properties/team.hpp"
#include "support/meshes.hpp"

/// The smallest meshes, exhausted: what goes wrong with three cells goes wrong in large meshes,
/// too, and most that goes wrong there does so with three cells. All worlds of a kind are one mesh,
/// which both engines refine and the verifier judges; a fault is shrunk to the one world that has
/// it.
namespace octetra::properties {
namespace {

/// Under sanitizers every so-manieth.
constexpr std::size_t stride = OCTETRA_SMALL_WORLDS_STRIDE;

std::vector<Mesh> thinned(const std::vector<Mesh>& worlds) {
    std::vector<Mesh> some;
    for (std::size_t i = 0; i < worlds.size(); i += stride) some.push_back(worlds[i]);
    return some;
}

/// On the first rank. Holds the case against the law that engines and verifier agree.
void expect_equality(const Case& c) {
    const std::string fault = judge(law_named("equality"), c);
    if (!fault.empty()) FAIL() << kept(shrunk({"equality", fault, c}));
}

/// Worlds of `cells` cells each: for each scheme and each choice of cells, which is a set of bits,
/// all worlds at once. Neighbours in a world are on different ranks.
void expect_equality_of_all(const std::string& kind, const std::vector<Mesh>& worlds,
                            const std::vector<unsigned>& choices) {
    const std::size_t cells = worlds.front().cells.size();
    Case c{.kind = kind, .mesh = side_by_side(worlds, 0x1p23)};
    for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
        c.cell_to_rank.push_back(static_cast<int>(i % cells));
    }
    for (const unsigned choice : choices) {
        c.selection.cells.clear();
        for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
            if ((choice >> (i % cells) & 1U) != 0) c.selection.cells.push_back(GlobalCell{i});
        }
        for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
            c.scheme = scheme;
            expect_equality(c);
            if (testing::Test::HasFailure()) return;
        }
    }
}

std::vector<unsigned> all_choices(std::size_t cells) {
    std::vector<unsigned> choices;
    for (unsigned choice = 1; choice < 1U << cells; ++choice) choices.push_back(choice);
    return choices;
}

TEST(SmallWorlds, OfOneCellInEveryOrderOfItsEdges) {
    lead([] {
        const auto worlds = one_cell_in_every_order();
        std::set<std::array<std::size_t, 6>> orders;
        for (const Mesh& world : worlds) orders.insert(order_of(world, CellIndex{0}));
        EXPECT_EQ(orders.size(), 720U);
        expect_equality_of_all("one cell", worlds, {1});
    });
}

/// The second cell chosen alone is the first one chosen alone of the pair the other way round.
TEST(SmallWorlds, OfTwoCellsAtAFaceInEveryPairOfOrders) {
    lead([] {
        const auto worlds = two_cells_in_every_order();
        std::set<std::pair<std::array<std::size_t, 6>, std::array<std::size_t, 6>>> orders;
        for (const Mesh& world : worlds) {
            orders.insert({order_of(world, CellIndex{0}), order_of(world, CellIndex{1})});
        }
        EXPECT_EQ(orders.size(), 120U * 120U);
        expect_equality_of_all("two cells at a face", thinned(worlds), {1, 3});
    });
}

/// Every complex, every choice of cells; of the orders of edges as many as random corners meet.
TEST(SmallWorlds, OfUpToThreeCellsInEveryComplexAndRandomOrders) {
    lead([] {
        const auto complexes = all_small_complexes();
        EXPECT_EQ(complexes.size(), 1U + 4U + 24U);
        constexpr std::size_t geometries = 40 / std::min<std::size_t>(stride, 20);
        for (std::size_t cells = 1; cells <= 3; ++cells) {
            std::vector<Mesh> worlds;
            for (const auto& complex : complexes) {
                if (complex.size() != cells) continue;
                for (std::size_t i = 0; i < geometries; ++i) {
                    worlds.push_back(some_geometry(complex, i));
                }
            }
            expect_equality_of_all("small complexes", worlds, all_choices(cells));
        }
    });
}

/// Six cells round an edge, once for each way to cut them between as many ranks.
Case rings(const Mesh& ring, std::size_t ranks) {
    std::size_t ways = 1;
    for (std::size_t cell = 0; cell < 6; ++cell) ways *= ranks;
    Case c{.kind = "rings", .mesh = side_by_side(std::vector<Mesh>(ways, ring), 4)};
    for (std::size_t way = 0; way < ways; ++way) {
        for (std::size_t cell = 0, digits = way; cell < 6; ++cell, digits /= ranks) {
            c.cell_to_rank.push_back(static_cast<int>(digits % ranks));
        }
    }
    return c;
}

class Rings : public testing::TestWithParam<double> {};

/// Between as many ranks as there are, up to three, for each one of the six cells chosen.
TEST_P(Rings, OfSixCellsCutInAllWaysYieldTheSame) {
    lead([] {
        const auto ranks = static_cast<std::size_t>(std::min(3, test::world().size()));
        Case c = rings(test::shaken_kuhn(1, GetParam(), 3), ranks);
        for (std::size_t chosen = 0; chosen < 6; ++chosen) {
            c.selection.cells.clear();
            for (std::size_t i = chosen; i < c.mesh.cells.size(); i += 6) {
                c.selection.cells.push_back(GlobalCell{i});
            }
            for (const auto& [scheme, levels] : {std::pair(Scheme::eight, 1), {Scheme::two, 3}}) {
                c.scheme = scheme;
                c.levels = levels;
                expect_equality(c);
                if (HasFailure()) return;
            }
        }
    });
}

INSTANTIATE_TEST_SUITE_P(WithTiesAndWithout, Rings, testing::Values(0.0, 0.2));

}  // namespace
}  // namespace octetra::properties
