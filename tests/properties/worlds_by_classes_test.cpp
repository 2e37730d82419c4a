#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "properties/census.hpp"
#include "properties/small_complexes.hpp"
#include "properties/team.hpp"
#include "properties/world_search.hpp"
#include "properties/worlds_equality.hpp"
#include "support/meshes.hpp"

/// The complexes of two and three cells whose edges have too many orders to try all. The tests
/// exhaust the influence between cells instead (order_classes.hpp).
namespace octetra::properties {
namespace {

/// All complexes except those that small_worlds_test.cpp exhausts in all orders: one cell, two at
/// an edge, two at a face, three in a row.
std::vector<Complex> complexes_by_classes() {
    std::vector<Complex> complexes = all_small_complexes();
    for (const Complex& other :
         {Complex{{0, 1, 2, 3}}, two_cells(2), two_cells(3), three_cells(2, 1, 1, 0)}) {
        std::erase(complexes, other);
    }
    return complexes;
}

TEST(SmallWorlds, AreOfTwentyNineComplexes) {
    EXPECT_EQ(all_small_complexes().size(), 1U + 4U + 24U);
    EXPECT_EQ(complexes_by_classes().size(), 2U + 23U);
}

/// Required combinations of each kind for complexes in which not all exist or can be found in
/// reasonable time.
using Known = std::map<Complex, CombinationCounts>;

const Known known_of_classes{
    {three_cells(0, 2, 2, 2), {2160, 2'400, 0}},    // of 3,072
    {three_cells(1, 2, 1, 1), {2160, 36'000, 0}},   // of 40,704
    {three_cells(2, 1, 1, 1), {2160, 130'000, 0}},  // of 170,496
};

const Known known_of_orders{
    {three_cells(0, 2, 2, 1), {2160, 144, 74'156}},        // of 75,600 of the third kind
    {three_cells(0, 2, 2, 2), {2160, 2'706, 347'184}},     // of 414,720
    {three_cells(1, 2, 1, 0), {2160, 3'744, 971'972}},     // of 972,000
    {three_cells(1, 2, 1, 1), {2160, 39'468, 2'047'920}},  // of 2,206,080
    {three_cells(2, 1, 0, 0), {2160, 1'152, 311'036}},     // of 311,040
    {three_cells(2, 1, 1, 1), {2160, 148'524, 729'012}},   // of 938,304
};

CombinationCounts to_be_met(const Complex& complex, const Known& known) {
    const auto place = known.find(complex);
    return place == known.end() ? count_combinations(complex) : place->second;
}

/// Worlds found on the way to a goal, which must have the required combinations.
std::vector<Mesh> worlds_that_meet(const CombinationCounts& least, const CombinationCounts& goal,
                                   const Complex& complex) {
    constexpr std::size_t patience = 2'000'000;
    Census census = empty_census(complex, goal[2] > 0);
    std::vector<Mesh> worlds;
    for (const auto& points : find_worlds(complex, goal, patience)) {
        note(census, points);
        worlds.push_back(test::mesh_of(points, complex));
    }
    for (std::size_t kind = 0; kind < 3; ++kind) EXPECT_GE(counts(census)[kind], least[kind]);
    return worlds;
}

/// Covers each order of each cell and each combination of classes; refines every fifth of the
/// worlds found.
TEST(SmallWorlds, OfTheOtherComplexesInAllCombinationsOfClasses) {
    run_on_first_rank([] {
        std::array<std::vector<Mesh>, 4> some;  // indexed by the number of cells
        for (const Complex& complex : complexes_by_classes()) {
            CombinationCounts goal = to_be_met(complex, known_of_classes);
            goal[2] = 0;
            const auto all = worlds_that_meet(goal, goal, complex);
            for (std::size_t i = 0; i < all.size(); i += 5 * stride) {
                some[complex.size()].push_back(all[i]);
            }
        }
        expect_equality_of_all("two cells, by classes", some[2], all_choices(2));
        expect_equality_of_all("three cells, by classes", some[3], all_choices(3));
    });
}

/// Covers each order of each cell with each combination of classes of the others, for the complex
/// with the number, from 1, in OCTETRA_COMPLEX, else for a small one. ./dev campaign worlds runs
/// all of them.
TEST(SmallWorlds, OfOneComplexInAllCombinationsOfOrdersAndClasses) {
    const char* const number = std::getenv("OCTETRA_COMPLEX");
    run_on_first_rank([&] {
        const Complex complex = number == nullptr
                                    ? three_cells(0, 2, 0, 0)
                                    : complexes_by_classes().at(std::stoul(number) - 1);
        const auto all = worlds_that_meet(to_be_met(complex, known_of_orders),
                                          count_combinations(complex), complex);
        constexpr std::size_t at_once = 10'000;
        for (std::size_t i = 0; i < all.size() && !HasFailure(); i += at_once) {
            const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i);
            const auto end = begin + static_cast<std::ptrdiff_t>(std::min(at_once, all.size() - i));
            expect_equality_of_all("one complex, by orders and classes", {begin, end},
                                   all_choices(complex.size()));
        }
    });
}

}  // namespace
}  // namespace octetra::properties
