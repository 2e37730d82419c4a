#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "files/hdf5/hdf5_layout.hpp"

/// The part of a VTKHDF file that HDF5 makes, for meshes too large to be written by a test.
namespace octetra {
namespace {

TEST(Hdf5Skeleton, IsSmallAndLeavesRoomForValuesOfAnyNumber) {
    constexpr std::uint64_t many = 100'000'000'000;
    const std::vector<Hdf5Group> groups{
        {"/A", {{"Version", std::vector<std::int64_t>{1, 0}}, {"Type", "B"}}}, {"/A/C"}};
    const std::vector<Hdf5Dataset> datasets{{"/A/none", "Int64", {0}},
                                            {"/A/x", "Float64", {many, 3}},
                                            {"/A/b", "UInt8", {many}},
                                            {"/A/C/i", "Int32", {1}}};
    const Hdf5Skeleton made = make_hdf5_skeleton(groups, datasets);
    ASSERT_EQ(made.values_at.size(), 4U);
    EXPECT_EQ(made.values_at[0], 0U);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> stretches{
        {made.values_at[1], 24 * many}, {made.values_at[2], many}, {made.values_at[3], 4}};
    std::uint64_t rest = 0;
    for (const Hdf5Bytes& one : made.rest) {
        stretches.emplace_back(one.position, one.bytes.size());
        rest += one.bytes.size();
    }
    EXPECT_LT(rest, 20'000U);
    std::ranges::sort(stretches);
    std::uint64_t at = 0;
    for (const auto& [begin, size] : stretches) {  // the whole file, each byte once
        EXPECT_EQ(begin, at);
        at = begin + size;
    }
    EXPECT_EQ(std::string(made.rest.front().bytes.data(), 8), "\x89HDF\r\n\x1a\n");

    const Hdf5Skeleton again = make_hdf5_skeleton(groups, datasets);
    EXPECT_EQ(again.values_at, made.values_at);
    EXPECT_TRUE(
        std::ranges::equal(again.rest, made.rest, {}, &Hdf5Bytes::bytes, &Hdf5Bytes::bytes));
}

}  // namespace
}  // namespace octetra
