#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/reference/history.hpp>
#include <octetra/verify/verify.hpp>

#include "distributed/world.hpp"
#include "properties/draw.hpp"
#include "properties/glued_cells.hpp"
#include "properties/small_worlds.hpp"
#include "verify/verdicts.hpp"

/// Small worlds, refined three times with the regular closure by both engines. Many worlds form one
/// mesh, and neighbours in a world are on different ranks.
namespace octetra::properties {
namespace {

using distributed::AdaptiveMesh;
using reference::CellMarks;
using reference::Refinement;

constexpr std::size_t step_count = 3;

/// A world of a kind, and the cells marked in it: in the first step a set of its cells, as bits; in
/// each later step one cell of the present mesh, by its number modulo their number.
struct MarkedWorld {
    std::size_t number = 0;
    std::array<std::size_t, step_count> marks{};
};

std::string words_of(const WorldKind& kind, const MarkedWorld& world) {
    return fmt::format("{}, world {}, marks {} {} {}", kind.name, world.number, world.marks[0],
                       world.marks[1], world.marks[2]);
}

/// Several worlds of a kind in one mesh.
struct Worlds {
    const WorldKind* kind;
    std::vector<MarkedWorld> all;
    Mesh input;

    Worlds(const WorldKind& of_kind, std::vector<MarkedWorld> worlds)
        : kind(&of_kind), all(std::move(worlds)) {
        std::vector<Mesh> meshes;
        for (const MarkedWorld& world : all) meshes.push_back(world_of(*kind, world.number));
        input = side_by_side(meshes, 0x1p23);
    }
    [[nodiscard]] std::size_t cells_of_one() const { return kind->complex.size(); }
    [[nodiscard]] const MarkedWorld& world_of_cell(const Refinement& mesh, CellIndex c) const {
        return all.at(mesh.maps.cell_to_parent[c].value() / cells_of_one());
    }
};

/// The canonical numbers of the cells that are marked in a step, ascending.
std::vector<std::uint64_t> marked_cells(const Worlds& worlds, const Refinement& present,
                                        std::size_t step) {
    std::vector<std::uint64_t> marked;
    CellIndex begin{0};
    for (const MarkedWorld& world : worlds.all) {
        CellIndex end = begin;
        while (end < present.mesh.cells.end_index() &&
               &worlds.world_of_cell(present, end) == &world) {
            ++end;
        }
        const std::size_t count = end.value() - begin.value();
        for (std::size_t c = 0; c < count; ++c) {
            const bool is_marked =
                step == 0 ? (world.marks[0] >> c & 1U) != 0 : c == world.marks[step] % count;
            if (is_marked) marked.push_back(begin.value() + c);
        }
        begin = end;
    }
    return marked;
}

/// The number of cells of a world after the steps that make it as marked; `steps` may be fewer.
std::size_t count_cells(const WorldKind& kind, const MarkedWorld& world, std::size_t steps) {
    const Worlds alone(kind, {world});
    reference::History history{alone.input, {}};
    for (std::size_t step = 0; step < steps; ++step) {
        const Refinement present = reference::replay(history).back();
        CellMarks marks(present.mesh.cells.size(), false);
        for (const std::uint64_t c : marked_cells(alone, present, step)) {
            marks[CellIndex{c}] = true;
        }
        history = reference::refined_regularly(history, marks);
    }
    return reference::replay(history).back().mesh.cells.size();
}

/// Collective. Marks cells by their canonical numbers, which the first rank has.
void refine(AdaptiveMesh& mesh, std::vector<std::uint64_t> marked) {
    mesh.processes().broadcast(marked);
    std::vector<std::uint8_t> marks;
    for (const std::uint64_t c : mesh.cell_numbers()) {
        marks.push_back(std::ranges::binary_search(marked, c) ? 1 : 0);
    }
    (void)mesh.refine(marks, {.closure = Closure::regular});
}

void expect_equal(const Worlds& worlds, const Mesh& found, const Refinement& expected) {
    if (found == expected.mesh) return;
    const auto cells = std::min(found.cells.end_index(), expected.mesh.cells.end_index());
    CellIndex c{0};
    while (c < cells && found.cells[c] == expected.mesh.cells[c]) ++c;
    ADD_FAILURE() << (c < cells ? words_of(*worlds.kind, worlds.world_of_cell(expected, c))
                                : "the points or the numbers of cells differ");
}

/// Collective. Refines all worlds together, and compares the result of each step.
void expect_equality(const Worlds& worlds) {
    const auto& ranks = test::world();
    std::vector<int> cell_to_rank;
    for (std::size_t c = 0; c < worlds.input.cells.size(); ++c) {
        const std::size_t in_world = c % worlds.cells_of_one();
        cell_to_rank.push_back(static_cast<int>(in_world) % ranks.size());
    }
    AdaptiveMesh mesh = AdaptiveMesh::distribute(ranks, worlds.input, cell_to_rank);
    reference::History history{worlds.input, {}};
    for (std::size_t step = 0; step < step_count; ++step) {
        std::vector<std::uint64_t> marked;
        if (ranks.is_first()) {
            const Refinement present = reference::replay(history).back();
            marked = marked_cells(worlds, present, step);
            CellMarks marks(present.mesh.cells.size(), false);
            for (const std::uint64_t c : marked) marks[CellIndex{c}] = true;
            history = reference::refined_regularly(history, marks);
        }
        refine(mesh, std::move(marked));
        const Mesh found = mesh.collect();
        if (!ranks.is_first()) continue;
        expect_equal(worlds, found, reference::replay(history).back());
        if (step + 1 < step_count) continue;
        const auto verdict =
            verify::verify_refinement(worlds.input, found, {.closure = Closure::regular});
        EXPECT_TRUE(verdict.valid()) << worlds.kind->name << ": " << test::codes_of(verdict);
    }
}

/// Collective. Tests the worlds, many at once.
void expect_equality_of_all(const WorldKind& kind, const std::vector<MarkedWorld>& worlds) {
    constexpr std::size_t at_once = 300;
    for (std::size_t i = 0; i < worlds.size(); i += at_once) {
        const auto begin = worlds.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = begin + static_cast<std::ptrdiff_t>(std::min(at_once, worlds.size() - i));
        expect_equality({kind, {begin, end}});
        if (test::world().max(testing::Test::HasFailure() ? 1 : 0) != 0) return;
    }
}

/// Every n-th world of a kind is tested.
struct Strides {
    std::size_t every_day = 1;  ///< greater under sanitizers
    std::size_t all = 1;        ///< if OCTETRA_ALL_REGULAR_WORLDS is set
};

bool are_all_requested() { return std::getenv("OCTETRA_ALL_REGULAR_WORLDS") != nullptr; }

std::vector<std::size_t> numbers(const WorldKind& kind, const Strides& strides) {
    const std::size_t stride =
        are_all_requested() ? strides.all : strides.every_day * OCTETRA_SMALL_WORLDS_STRIDE;
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < count_worlds(kind); i += stride) some.push_back(i);
    return some;
}

/// All marks of a world: every set of cells, then every cell of the mesh that this makes, and then
/// every cell of the next mesh, or every n-th.
std::vector<MarkedWorld> with_all_marks(const WorldKind& kind, std::size_t number,
                                        std::size_t stride) {
    std::vector<MarkedWorld> all;
    for (std::size_t cells = 1; cells < std::size_t{1} << kind.complex.size(); ++cells) {
        const std::size_t count = count_cells(kind, {number, {cells, 0, 0}}, 1);
        for (std::size_t second = 0; second < count; ++second) {
            const std::size_t count_then = count_cells(kind, {number, {cells, second, 0}}, 2);
            for (std::size_t c = second % stride; c < count_then; c += stride) {
                all.push_back({number, {cells, second, c}});
            }
        }
    }
    return all;
}

void expect_equality_for_all_marks(const WorldKind& kind, const Strides& strides) {
    for (const std::size_t number : numbers(kind, strides)) {
        expect_equality_of_all(kind, with_all_marks(kind, number, are_all_requested() ? 1 : 29));
    }
}

/// Marks that the number of the world determines.
void expect_equality_for_random_marks(const WorldKind& kind, const Strides& strides) {
    std::vector<MarkedWorld> worlds;
    for (const std::size_t number : numbers(kind, strides)) {
        Draw draw(number);
        const std::size_t sets = (std::size_t{1} << kind.complex.size()) - 1;
        worlds.push_back(
            {number, {1 + draw.below(sets), draw.below(720'720), draw.below(720'720)}});
    }
    expect_equality_of_all(kind, worlds);
}

TEST(RegularWorlds, OfOneCellForEverySequenceOfThreeMarks) {
    expect_equality_for_all_marks(one_cell(), {.every_day = 144, .all = 19});
}

TEST(RegularWorlds, OfTwoCellsAtAFaceForEverySequenceOfThreeMarks) {
    expect_equality_for_all_marks(two_cells_at_a_face(), {.every_day = 14'400, .all = 2'881});
}

TEST(RegularWorlds, OfTwoCellsAtAnEdgeForEverySequenceOfThreeMarks) {
    expect_equality_for_all_marks(two_cells_at_an_edge(), {.every_day = 64'800, .all = 12'961});
}

TEST(RegularWorlds, OfThreeCellsInARowForEverySequenceOfThreeMarks) {
    expect_equality_for_all_marks(three_cells_in_a_row(),
                                  {.every_day = 2'592'000, .all = 2'592'000});
}

TEST(RegularWorlds, OfTwoCellsAtAFaceInEveryPairOfOrders) {
    expect_equality_for_random_marks(two_cells_at_a_face(), {.every_day = 97});
}

TEST(RegularWorlds, OfTwoCellsAtAnEdgeInEveryPairOfOrders) {
    expect_equality_for_random_marks(two_cells_at_an_edge(), {.every_day = 433, .all = 5});
}

TEST(RegularWorlds, OfThreeCellsInARowInEveryOrder) {
    expect_equality_for_random_marks(three_cells_in_a_row(), {.every_day = 17'351, .all = 577});
}

}  // namespace
}  // namespace octetra::properties
