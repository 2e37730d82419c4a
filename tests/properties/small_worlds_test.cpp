#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "distributed/world.hpp"
#include "properties/glued_cells.hpp"
#include "properties/small_worlds.hpp"
#include "properties/team.hpp"
#include "properties/worlds_equality.hpp"
#include "support/meshes.hpp"

/// The smallest meshes are tested exhaustively, because most faults of large meshes already occur
/// with three cells. All worlds of a kind form one mesh, which both engines refine and the verifier
/// checks; a fault is shrunk to the single world that has it.
namespace octetra::properties {
namespace {

/// The worlds with the numbers first, first + step, ... below `end`.
std::vector<Mesh> worlds(const WorldKind& kind, std::size_t first, std::size_t end,
                         std::size_t step) {
    std::vector<Mesh> some;
    for (std::size_t i = first; i < end; i += step) some.push_back(world_of(kind, i));
    return some;
}

std::vector<Mesh> every(std::size_t step, const WorldKind& kind) {
    return worlds(kind, 0, count_worlds(kind), step);
}

/// The number of distinct orders of the edges.
std::size_t count_orders(const std::vector<Mesh>& worlds) {
    std::set<std::vector<Order>> orders;
    for (const Mesh& world : worlds) {
        std::vector<Order> of_cells;
        for (CellIndex c{0}; c < world.cells.end_index(); ++c) {
            of_cells.push_back(order_of(world, c));
        }
        orders.insert(of_cells);
    }
    return orders.size();
}

TEST(SmallWorlds, OfOneCellInEveryOrderOfItsEdges) {
    run_on_first_rank([] {
        const auto all = every(1, one_cell());
        EXPECT_EQ(count_orders(all), 720U);
        expect_equality_of_all("one cell", all, {1});
    });
}

/// Marking only the second cell is the same as marking only the first one of the mirrored pair.
TEST(SmallWorlds, OfTwoCellsAtAFaceInEveryPairOfOrders) {
    run_on_first_rank([] {
        const auto all = every(stride, two_cells_at_a_face());
        EXPECT_EQ(count_orders(all), all.size());
        expect_equality_of_all("two cells at a face", all, {1, 3});
    });
}

/// Worlds grouped by the 180 orders of the first cell: every `step`-th; or, if OCTETRA_FIRST_CELL
/// is a number from 1 to 180, all those with this order. ./dev campaign worlds runs all of them.
std::vector<Mesh> worlds_by_first_cell(const WorldKind& kind, std::size_t step) {
    const char* const number = std::getenv("OCTETRA_FIRST_CELL");
    if (number == nullptr) return every(step * stride, kind);
    const std::size_t of_each_order = count_worlds(kind) / 180;
    const std::size_t end = std::stoul(number) * of_each_order;
    return worlds(kind, end - of_each_order, end, 1);
}

TEST(SmallWorlds, OfTwoCellsAtAnEdgeInEveryPairOfOrders) {
    run_on_first_rank([] {
        const auto some = worlds_by_first_cell(two_cells_at_an_edge(), 17);
        EXPECT_EQ(count_orders(some), some.size());
        expect_equality_of_all("two cells at an edge", some, {1, 3});
    });
}

TEST(SmallWorlds, OfThreeCellsInARowInEveryOrderOfTheirEdges) {
    run_on_first_rank([] {
        const auto some = worlds_by_first_cell(three_cells_in_a_row(), 577);
        EXPECT_EQ(count_orders(some), some.size());
        expect_equality_of_all("three cells in a row", some, all_choices(3));
    });
}

/// The worlds of a kind with numbers from `begin` on and below `end`.
struct Part {
    const WorldKind* kind = nullptr;
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// All worlds up to exchange, kind by kind; a kind is divided into equal parts of at most some
/// minutes.
std::vector<Part> parts_up_to_exchange() {
    constexpr std::size_t most = 110'000;
    std::vector<Part> parts;
    for (const WorldKind& kind : kinds_up_to_exchange()) {
        const std::size_t worlds = count_worlds(kind);
        const std::size_t count = (worlds + most - 1) / most;
        for (std::size_t i = 0; i < count; ++i) {
            parts.push_back({&kind, i * worlds / count, (i + 1) * worlds / count});
        }
    }
    return parts;
}

void expect_equality_of_part(const Part& part) {
    constexpr std::size_t at_once = 10'000;
    for (std::size_t i = part.begin; i < part.end && !testing::Test::HasFailure(); i += at_once) {
        const auto some = worlds(*part.kind, i, std::min(i + at_once, part.end), 1);
        EXPECT_EQ(count_orders(some), some.size());
        expect_equality_of_all(part.kind->name, some, all_choices(part.kind->complex.size()));
    }
}

/// About 250 worlds of a kind. A step that is coprime to their number covers all orders of each
/// cell.
std::vector<Mesh> some_worlds(const WorldKind& kind) {
    const std::size_t count = count_worlds(kind);
    std::size_t step = stride * std::max<std::size_t>(1, count / 250);
    while (std::gcd(step, count) != 1) ++step;
    return every(step, kind);
}

/// Some worlds of each kind; or, if OCTETRA_PART_UP_TO_EXCHANGE is a number from 1, all those of
/// this part. ./dev campaign worlds runs all parts.
TEST(SmallWorlds, OfEightMoreComplexesInEveryOrderOfTheirEdges) {
    const char* const number = std::getenv("OCTETRA_PART_UP_TO_EXCHANGE");
    run_on_first_rank([&] {
        if (number != nullptr) {
            expect_equality_of_part(parts_up_to_exchange().at(std::stoul(number) - 1));
            return;
        }
        for (const WorldKind& kind : kinds_up_to_exchange()) {
            const auto some = some_worlds(kind);
            EXPECT_EQ(count_orders(some), some.size());
            expect_equality_of_all(kind.name, some, all_choices(kind.complex.size()));
        }
    });
}

/// These are parts 206 to 261 of ./dev campaign worlds.
TEST(SmallWorlds, UpToExchangeAreFiftySixParts) { EXPECT_EQ(parts_up_to_exchange().size(), 56U); }

/// Six cells round an edge, once for each way to partition them.
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

/// On up to three ranks, with each one of the six cells marked.
TEST_P(Rings, OfSixCellsWithAllPartitionsYieldTheSame) {
    run_on_first_rank([] {
        const auto ranks = static_cast<std::size_t>(std::min(3, test::world().size()));
        Case c = rings(test::perturbed_kuhn(1, GetParam(), 3), ranks);
        for (std::size_t marked = 0; marked < 6; ++marked) {
            c.selection.cells.clear();
            for (std::size_t i = marked; i < c.mesh.cells.size(); i += 6) {
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
