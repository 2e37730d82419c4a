#include "pattern/patterns.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bisect.hpp"
#include "pattern/length_order.hpp"
#include "support/meshes.hpp"

/// Compares the tables with the recursion of the reference, for every order of the edges and every
/// selection.
namespace octetra::distributed {
namespace {

using LongestFirst = std::array<std::size_t, 6>;

Comparisons comparisons_of(const LongestFirst& longest_first) {
    unsigned comparisons = 0;
    unsigned pair = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j, ++pair) {
            const auto place_i = std::ranges::find(longest_first, i);
            const auto place_j = std::ranges::find(longest_first, j);
            if (place_i < place_j) comparisons |= 1U << pair;
        }
    }
    return static_cast<Comparisons>(comparisons);
}

template <class F>
void for_each_order(F&& f) {
    LongestFirst longest_first{0, 1, 2, 3, 4, 5};
    do {
        f(longest_first, PatternTable::get().order(comparisons_of(longest_first)));
    } while (std::ranges::next_permutation(longest_first).found);
}

TEST(PatternTable, BisectsAsTheReferenceDoesForEveryOrderAndClosedSelection) {
    const PatternTable& table = PatternTable::get();
    std::size_t compared = 0;
    for_each_order([&](const LongestFirst& longest_first, LengthOrder order) {
        for (unsigned mask = 0; mask < 64; ++mask) {
            const auto marked = static_cast<EdgeMask>(mask);
            if (table.closure(order, marked) != marked) continue;
            std::vector<reference::BisectedEdge> edges;
            for (const std::size_t e : longest_first) {
                if ((mask >> e & 1U) == 0) continue;
                edges.push_back({{VertexIndex{cell_edges[e][0]}, VertexIndex{cell_edges[e][1]}},
                                 VertexIndex{4 + e}});
            }
            std::vector<CellVertices> expected;
            reference::bisect<4>({VertexIndex{0}, VertexIndex{1}, VertexIndex{2}, VertexIndex{3}},
                                 edges, expected);
            const Pattern& pattern = table.pattern(order, marked);
            ASSERT_EQ(pattern.child_count, expected.size());
            for (std::size_t k = 0; k < expected.size(); ++k) {
                for (std::size_t i = 0; i < 4; ++i) {
                    ASSERT_EQ(VertexIndex{pattern.children[k][i]}, expected[k][i]);
                }
            }
            ++compared;
        }
    });
    EXPECT_GT(compared, 720U * 10);
}

TEST(PatternTable, ClosesByTheFaceRuleAndNoFurther) {
    const PatternTable& table = PatternTable::get();
    constexpr std::array<std::array<std::size_t, 3>, 4> edges_of_face{
        {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}}};
    for_each_order([&](const LongestFirst& longest_first, LengthOrder order) {
        EXPECT_EQ(table.longest_edge(order), longest_first.front());
        for (unsigned mask = 0; mask < 64; ++mask) {
            unsigned closed = mask;
            for (int sweep = 0; sweep < 6; ++sweep) {
                for (const auto& face : edges_of_face) {
                    const auto longest = std::ranges::min(face, {}, [&](std::size_t e) {
                        return std::ranges::find(longest_first, e);
                    });
                    if (std::ranges::any_of(face, [&](auto e) { return closed >> e & 1U; })) {
                        closed |= 1U << longest;
                    }
                }
            }
            ASSERT_EQ(table.closure(order, static_cast<EdgeMask>(mask)), closed);
        }
    });
}

void expect_the_strict_order(const Mesh& mesh, CellVertices cell) {
    std::ranges::sort(cell);
    do {
        LongestFirst longest_first{0, 1, 2, 3, 4, 5};
        std::ranges::sort(longest_first, [&](std::size_t e, std::size_t f) {
            const auto segment = [&](std::size_t k) {
                return Segment{mesh.points[cell[cell_edges[k][0]]],
                               mesh.points[cell[cell_edges[k][1]]]};
            };
            return longer(segment(e), segment(f));
        });
        ASSERT_EQ(length_order(mesh.points, cell),
                  PatternTable::get().order(comparisons_of(longest_first)));
    } while (std::ranges::next_permutation(cell).found);
}

TEST(LengthOrder, IsThatOfTheStrictOrderOnLatticesFullOfTies) {
    const Mesh mesh = test::kuhn(2, 2, 2);
    for (const CellVertices& cell : mesh.cells) expect_the_strict_order(mesh, cell);
}

TEST(LengthOrder, IsThatOfTheStrictOrderWhereSquaresOverflowOrLoseDigits) {
    std::mt19937_64 random(1);
    for (const int exponent : {-1074, -1040, -540, -530, -460, -450, 480, 500, 600, 1000}) {
        for (int i = 0; i < 200; ++i) {
            Mesh mesh;
            for (int v = 0; v < 4; ++v) {
                const auto coordinate = [&] {
                    return std::scalbn(static_cast<double>(random() % 1024), exponent);
                };
                mesh.points.push_back({coordinate(), coordinate(), coordinate()});
            }
            expect_the_strict_order(
                mesh, {VertexIndex{0}, VertexIndex{1}, VertexIndex{2}, VertexIndex{3}});
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
