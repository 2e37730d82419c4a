#include <type_traits>

#include <gtest/gtest.h>

#include <octetra/core/index.hpp>

namespace octetra {
namespace {

static_assert(!std::is_convertible_v<VertexIndex, CellIndex>);
static_assert(!std::is_constructible_v<VertexIndex, CellIndex>);
static_assert(!std::is_convertible_v<std::size_t, VertexIndex>);
static_assert(!std::is_convertible_v<VertexIndex, std::size_t>);
static_assert(sizeof(VertexIndex) == 4 && sizeof(GlobalCell) == 8);

template <class Vector, class Subscript>
concept subscriptable = requires(Vector v, Subscript i) {
    v[i];
};
static_assert(subscriptable<IndexVector<CellIndex, int>, CellIndex>);
static_assert(!subscriptable<IndexVector<CellIndex, int>, VertexIndex>);
static_assert(!subscriptable<IndexVector<CellIndex, int>, std::size_t>);

TEST(Index, IsNoneUntilItIsGivenANumber) {
    EXPECT_TRUE(VertexIndex{}.is_none());
    EXPECT_FALSE(VertexIndex{0}.is_none());
    EXPECT_EQ(VertexIndex{}, VertexIndex::none());
}

TEST(IndexVector, AppendReturnsTheNumberOfTheNewElement) {
    IndexVector<CellIndex, int> v;
    EXPECT_EQ(v.append(7), CellIndex{0});
    EXPECT_EQ(v.append(8), CellIndex{1});
    EXPECT_EQ(v[CellIndex{1}], 8);
    EXPECT_EQ(v.end_index(), CellIndex{2});
}

}  // namespace
}  // namespace octetra
