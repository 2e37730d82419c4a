#include "properties/order_classes.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "properties/glued_cells.hpp"
#include "properties/one_level.hpp"
#include "properties/small_worlds.hpp"

namespace octetra::properties {
namespace {

TEST(OrderClasses, NumberOrdersLexicographically) {
    Order order{0, 1, 2, 3, 4, 5};
    for (std::size_t number = 0; number < order_count; ++number) {
        EXPECT_EQ(number_of(order), number);
        std::ranges::next_permutation(order);
    }
}

/// For all orders and all sets of edges, compares with the closure in a mesh of one cell.
TEST(OrderClasses, CloseACellAsAMeshOfOneCellIsClosed) {
    for (std::size_t number = 0; number < order_count; ++number) {
        const Mesh mesh = world_of(one_cell(), number);
        const Order order = order_of(mesh, CellIndex{0});
        const auto edges = edges_of(mesh.cells[CellIndex{0}]);
        const auto set_of = [&](EdgeBits bits) {
            Edges set;
            for (std::size_t e = 0; e < 6; ++e) {
                if ((bits >> e & 1U) != 0) set.insert(edges[e]);
            }
            return set;
        };
        for (EdgeBits marked = 0; marked < 1U << 6U; ++marked) {
            ASSERT_EQ(set_of(closed_in_cell(order, marked)), closure_of(mesh, set_of(marked)));
        }
    }
}

/// A cell without neighbours has one class. With one shared edge, 01, classes differ by the least
/// scheme that marks it: 2t (the longest edge), 4t (the longest of a face), or neither.
TEST(OrderClasses, AreAsManyAsWasCountedByHand) {
    const auto class_sizes = [](EdgeBits shared) {
        std::vector<std::size_t> sizes;
        for (const OrderClass& one : classes_of_orders(shared).classes) sizes.push_back(one.size);
        std::ranges::sort(sizes);
        return sizes;
    };
    EXPECT_EQ(class_sizes(0), std::vector<std::size_t>{720});
    EXPECT_EQ(class_sizes(0b000001), (std::vector<std::size_t>{120, 216, 384}));
}

}  // namespace
}  // namespace octetra::properties
