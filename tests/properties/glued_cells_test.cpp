#include "properties/glued_cells.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "properties/small_complexes.hpp"
#include "properties/small_worlds.hpp"
#include "properties/team.hpp"

/// Tests that the worlds up to exchange are complete and distinct: the sizes of their orbits under
/// the symmetries of the complex add up to the number of ways to order the edges.
namespace octetra::properties {
namespace {

using CornerPermutation = std::array<std::size_t, 4>;

/// For each order of a cell by number, the order after its corners are permuted.
using NewOrders = std::vector<std::uint64_t>;

NewOrders new_orders(const CornerPermutation& permutation) {
    std::array<std::size_t, 6> new_edges{};
    for (std::size_t e = 0; e < 6; ++e) {
        while (edge_of({0, 1, 2, 3}, new_edges[e]) != edge_of(permutation, e)) ++new_edges[e];
    }
    NewOrders result;
    Order order{0, 1, 2, 3, 4, 5};
    do {
        Order image{};
        for (std::size_t i = 0; i < 6; ++i) image[i] = new_edges[order[i]];
        result.push_back(number_of(image));
    } while (std::ranges::next_permutation(order).found);
    return result;
}

/// The effect of a symmetry on the order of each cell, and the position of the new order's number
/// among those of all cells, which are encoded as one number.
struct Symmetry {
    std::array<const NewOrders*, 3> orders{};
    std::array<unsigned, 3> shift{};
};

Symmetry symmetry(const Complex& complex, const std::vector<std::size_t>& numbers) {
    static std::map<CornerPermutation, NewOrders> known;
    Symmetry result;
    for (std::size_t c = 0; c < complex.size(); ++c) {
        CornerPermutation image{};
        for (std::size_t i = 0; i < 4; ++i) image[i] = numbers[complex[c][i]];
        const auto other = std::ranges::find_if(
            complex, [&](const auto& cell) { return std::ranges::is_permutation(cell, image); });
        CornerPermutation permutation{};
        for (std::size_t i = 0; i < 4; ++i) {
            while ((*other)[permutation[i]] != image[i]) ++permutation[i];
        }
        if (!known.contains(permutation)) known[permutation] = new_orders(permutation);
        result.orders[c] = &known[permutation];
        result.shift[c] = 10 * static_cast<unsigned>(other - complex.begin());
    }
    return result;
}

/// The orbit of a world under symmetries.
struct Orbit {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::size_t size = 0;
};

/// `orders` are those of its cells, by number. The size of the orbit is that of the group divided
/// by that of the stabiliser.
Orbit orbit_of(const std::vector<std::size_t>& orders, const std::vector<Symmetry>& all) {
    Orbit orbit;
    std::size_t times = 0;
    for (const Symmetry& one : all) {
        std::uint64_t image = 0;
        for (std::size_t c = 0; c < orders.size(); ++c) {
            image |= (*one.orders[c])[orders[c]] << one.shift[c];
        }
        if (image < orbit.least) {
            orbit.least = image;
            times = 0;
        }
        if (image == orbit.least) ++times;
    }
    orbit.size = all.size() / std::max<std::size_t>(times, 1);  // the identity counts, too
    return orbit;
}

/// Computed from the lengths in the world.
std::vector<std::size_t> orders_in(Mesh world, const Complex& complex) {
    world.cells.clear();
    std::vector<std::size_t> numbers;
    for (const auto& [a, b, c, d] : complex) {
        const CellIndex cell =
            world.cells.append({VertexIndex{a}, VertexIndex{b}, VertexIndex{c}, VertexIndex{d}});
        numbers.push_back(number_of(order_of(world, cell)));
    }
    return numbers;
}

/// The kinds of one complex, and the number of ways to order its edges.
struct Whole {
    std::vector<WorldKind> kinds;
    std::size_t ways = 0;
};

void expect_each_once(const Whole& whole) {
    const Complex& complex = whole.kinds.front().complex;
    std::vector<Symmetry> all;
    for (const auto& numbers : symmetries(complex)) all.push_back(symmetry(complex, numbers));
    std::vector<std::uint64_t> worlds;
    std::size_t ways = 0;
    for (const WorldKind& kind : whole.kinds) {
        for (std::size_t number = 0; number < count_worlds(kind); ++number) {
            const Orbit orbit = orbit_of(orders_in(world_of(kind, number), complex), all);
            worlds.push_back(orbit.least);
            ways += orbit.size;
        }
    }
    const std::size_t count = worlds.size();
    std::ranges::sort(worlds);
    worlds.erase(std::unique(worlds.begin(), worlds.end()), worlds.end());
    EXPECT_EQ(worlds.size(), count) << whole.kinds.front().name;
    EXPECT_EQ(ways, whole.ways) << whole.kinds.front().name;
}

WorldKind without_last_cell(WorldKind kind) {
    kind.complex.pop_back();
    kind.cells.pop_back();
    return kind;
}

/// 720^2 ways without a common face, 720 * 120 with one.
TEST(GluedCells, OfTwoCellsUpToExchangeAreEachOnce) {
    run_on_first_rank([] {
        const auto& kinds = kinds_up_to_exchange();
        expect_each_once({{kinds[0]}, 720 * 720});
        expect_each_once({{kinds[1]}, 720 * 720});
        expect_each_once({{without_last_cell(kinds[5])}, 720 * 120});
        expect_each_once({{without_last_cell(kinds[6]), without_last_cell(kinds[7])}, 720 * 720});
    });
}

/// ./dev test counts one complex of six: two cells at a face and one apart. If
/// OCTETRA_COUNT_ALL_WORLDS is set, as in part 206 of ./dev campaign worlds, all are counted.
TEST(GluedCells, OfThreeCellsUpToExchangeAreEachOnce) {
    run_on_first_rank([] {
        constexpr std::size_t ways = 720 * 720 * 720;
        const auto& kinds = kinds_up_to_exchange();
        expect_each_once({{kinds[5]}, 720 * 120 * 720});
        if (std::getenv("OCTETRA_COUNT_ALL_WORLDS") == nullptr) return;
        expect_each_once({{kinds[2]}, ways});
        expect_each_once({{kinds[3]}, ways});
        expect_each_once({{kinds[4]}, ways});
        expect_each_once({{kinds[6], kinds[7]}, ways});
        expect_each_once({{kinds[8], kinds[9]}, ways});
    });
}

}  // namespace
}  // namespace octetra::properties
