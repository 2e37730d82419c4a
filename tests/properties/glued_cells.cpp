#include "properties/glued_cells.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "properties/gluing.hpp"

namespace octetra::properties {
namespace {

// ---- orders up to the names of corners ----------------------------------------------------------

/// The position in the order of each of the edges 01 02 03 12 13 23.
using EdgePositions = std::array<std::size_t, 6>;

/// All orders that satisfy the predicate.
template <class Predicate>
std::vector<Order> orders(Predicate&& is_wanted) {
    std::vector<Order> result;
    Order order{0, 1, 2, 3, 4, 5};
    do {
        EdgePositions place{};
        for (std::size_t i = 0; i < 6; ++i) place[order[i]] = i;
        if (is_wanted(place)) result.push_back(order);
    } while (std::ranges::next_permutation(order).found);
    return result;
}

std::vector<Order> all_orders() {
    return orders([](const EdgePositions&) { return true; });
}

/// The orders in which the edges of the face 012 descend.
std::vector<Order> orders_at_a_face() {
    return orders([](const EdgePositions& at) { return at[0] < at[1] && at[1] < at[3]; });
}

/// The orders in which 02 is longer than 03; exchanging the corners 2 and 3 yields the others.
std::vector<Order> orders_at_an_edge() {
    return orders([](const EdgePositions& at) { return at[1] < at[2]; });
}

bool is_02_longest_of_four(const EdgePositions& at) {
    return at[1] < at[2] && at[1] < at[3] && at[1] < at[4];
}

/// The orders in which 02 is the longest of the edges 02, 03, 12 and 13; exchanging the corners 0
/// and 1, or 2 and 3, yields the others.
std::vector<Order> orders_with_a_marked_edge() { return orders(is_02_longest_of_four); }

/// The orders in which the edges of the vertex 0 descend.
std::vector<Order> orders_at_a_vertex() {
    return orders([](const EdgePositions& at) { return at[0] < at[1] && at[1] < at[2]; });
}

/// The orders in which 01 is the longest edge, and 02 the longest of the edges that meet it.
std::vector<Order> orders_apart() {
    return orders([](const EdgePositions& at) { return at[0] == 0 && is_02_longest_of_four(at); });
}

// ---- numbers ------------------------------------------------------------------------------------

/// The number of multisets of `cells` orders.
std::size_t count_multisets(std::size_t orders, std::size_t cells) {
    std::size_t ways = 1;
    for (std::size_t i = 0; i < cells; ++i) ways = ways * (orders + i) / (i + 1);
    return ways;
}

std::size_t count_multisets(const InterchangeableCells& cells) {
    return count_multisets(cells.orders.size(), cells.count);
}

/// Appends the multiset of orders with this number. Multisets of the first n orders precede all
/// others: hence the last order is found first, and then the one before it, which may be equal.
void add_orders(std::vector<Order>& result, const InterchangeableCells& cells, std::size_t number) {
    std::size_t last = cells.orders.size();
    for (std::size_t left = cells.count; left > 0; --left) {
        while (count_multisets(last, left) > number) --last;
        result.push_back(cells.orders[last]);
        number -= count_multisets(last, left);
    }
}

std::vector<Order> orders_of_world(const WorldKind& kind, std::size_t number) {
    std::size_t behind = count_worlds(kind);
    std::vector<Order> result;
    for (const InterchangeableCells& cells : kind.cells) {
        behind /= count_multisets(cells);
        add_orders(result, cells, number / behind);
        number %= behind;
    }
    return result;
}

// ---- complexes ----------------------------------------------------------------------------------

const std::array<std::size_t, 4> first{0, 1, 2, 3};

/// A marked edge is at the vertex 0 or at 1, and exchanging these two vertices exchanges this for
/// all cells. So of two cells both have theirs at 0, or the last one has it at 1; three cells
/// likewise.
std::vector<WorldKind> kinds_at_an_edge() {
    const InterchangeableCells one{orders_with_a_marked_edge(), 1};
    const InterchangeableCells two{orders_with_a_marked_edge(), 2};
    const InterchangeableCells three{orders_with_a_marked_edge(), 3};
    const InterchangeableCells one_apart{orders_apart(), 1};
    return {
        {"two cells at an edge, one apart", {first, {0, 1, 4, 5}, {6, 7, 8, 9}}, {two, one_apart}},
        {"two cells at an edge, one turned, one apart",
         {first, {1, 0, 4, 5}, {6, 7, 8, 9}},
         {two, one_apart}},
        {"three cells at an edge", {first, {0, 1, 4, 5}, {0, 1, 6, 7}}, {three}},
        {"three cells at an edge, one turned", {first, {0, 1, 4, 5}, {1, 0, 6, 7}}, {two, one}},
    };
}

std::vector<WorldKind> make_kinds_up_to_exchange() {
    const auto at_vertex = orders_at_a_vertex();
    const auto at_face = orders_at_a_face();
    const auto apart = orders_apart();
    std::vector<WorldKind> kinds{
        {"two cells apart", {first, {4, 5, 6, 7}}, {{apart, 2}}},
        {"two cells at a vertex", {first, {0, 4, 5, 6}}, {{at_vertex, 2}}},
        {"three cells apart", {first, {4, 5, 6, 7}, {8, 9, 10, 11}}, {{apart, 3}}},
        {"two cells at a vertex, one apart",
         {first, {0, 4, 5, 6}, {7, 8, 9, 10}},
         {{at_vertex, 2}, {apart, 1}}},
        {"three cells at a vertex", {first, {0, 4, 5, 6}, {0, 7, 8, 9}}, {{at_vertex, 3}}},
        {"two cells at a face, one apart",
         {first, {0, 2, 1, 4}, {5, 6, 7, 8}},
         {{at_face, 2}, {apart, 1}}},
    };
    std::ranges::move(kinds_at_an_edge(), std::back_inserter(kinds));
    return kinds;
}

}  // namespace

std::size_t count_worlds(const WorldKind& kind) {
    std::size_t count = 1;
    for (const InterchangeableCells& cells : kind.cells) count *= count_multisets(cells);
    return count;
}

Mesh world_of(const WorldKind& kind, std::size_t number) {
    return glued(kind.complex, orders_of_world(kind, number));
}

const WorldKind& one_cell() {
    static const WorldKind kind{"one cell", {first}, {{all_orders()}}};
    return kind;
}

const WorldKind& two_cells_at_a_face() {
    static const WorldKind kind{
        "two cells at a face", {first, {0, 2, 1, 4}}, {{orders_at_a_face()}, {orders_at_a_face()}}};
    return kind;
}

const WorldKind& two_cells_at_an_edge() {
    static const WorldKind kind{"two cells at an edge",
                                {first, {0, 1, 4, 5}},
                                {{orders_with_a_marked_edge()}, {orders_at_an_edge()}}};
    return kind;
}

const WorldKind& three_cells_in_a_row() {
    static const WorldKind kind{
        "three cells in a row",
        {first, {0, 2, 1, 4}, {0, 1, 3, 5}},
        {{orders_with_a_marked_edge()}, {orders_at_a_face()}, {orders_at_a_face()}}};
    return kind;
}

const std::vector<WorldKind>& kinds_up_to_exchange() {
    static const std::vector<WorldKind> kinds = make_kinds_up_to_exchange();
    return kinds;
}

}  // namespace octetra::properties
