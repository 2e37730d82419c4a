#include <algorithm>
#include <bit>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "distributed/exact_value.hpp"
#include "estimate/exact_sum.hpp"
#include "estimate/ranked_indicators.hpp"

namespace octetra::distributed {
namespace {

using test::exact_unit;
using test::exact_value;
using test::Whole;

constexpr double greatest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double least_normal = std::numeric_limits<double>::min();

ExactSum sum_of(const std::vector<double>& addends) {
    ExactSum sum;
    for (const double addend : addends) sum.add(addend);
    return sum;
}

/// In units of 2^-1074.
Whole value_of(const ExactSum& sum) {
    Whole value = 0;
    for (std::size_t i = ExactSum::limb_count; i-- > 0;) {
        EXPECT_EQ(sum.limbs()[i] >> 32U, 0U);
        value = (value << 32U) + sum.limbs()[i];
    }
    return value;
}

Whole value_of(const std::vector<double>& addends) {
    Whole value = 0;
    for (const double addend : addends) value += exact_value(addend);
    return value >> (exact_unit - 1074U);
}

/// Doubles of all magnitudes: all bit patterns are equally likely.
std::vector<double> random_doubles(std::size_t count, std::uint64_t seed) {
    constexpr auto bits_of_greatest = std::bit_cast<std::uint64_t>(greatest);
    std::mt19937_64 random(seed);
    std::vector<double> doubles(count);
    std::ranges::generate(doubles,
                          [&] { return std::bit_cast<double>(random() % bits_of_greatest); });
    return doubles;
}

const std::vector<double> all_sorts{0,
                                    least,
                                    3 * least,
                                    std::nextafter(least_normal, 0),
                                    least_normal,
                                    0x1p-60,
                                    0.1,
                                    1.0 / 3,
                                    1,
                                    0x1.fffffffffffffp31,
                                    0x1.fffffffffffffp32,
                                    1e22,
                                    1e308,
                                    greatest};

TEST(ExactSum, OfOneOrTwoDoublesHasNoError) {
    EXPECT_EQ(sum_of({}), ExactSum());
    for (const double a : all_sorts) {
        EXPECT_EQ(value_of(sum_of({a})), value_of({a})) << a;
        for (const double b : all_sorts) {
            const std::vector<double> both{a, b};
            EXPECT_EQ(value_of(sum_of(both)), value_of(both)) << a << " + " << b;
        }
    }
}

TEST(ExactSum, OfManyDoublesHasNoErrorInAnyOrder) {
    const std::vector<double> tenths(std::size_t{1} << 20U, 0.1);
    EXPECT_EQ(value_of(sum_of(tenths)), value_of(sum_of({0.1})) << 20U);
    const std::vector<double> great(100'000, greatest);
    EXPECT_EQ(value_of(sum_of(great)), value_of(sum_of({greatest})) * 100'000);
    std::vector<double> mixed = random_doubles(20'000, 1);
    const ExactSum sum = sum_of(mixed);
    EXPECT_EQ(value_of(sum), value_of(mixed));
    std::ranges::shuffle(mixed, std::mt19937_64(2));
    EXPECT_EQ(sum_of(mixed), sum);
}

/// Carries propagate through limbs of all ones after an addition to the lowest.
TEST(ExactSum, CarriesThroughAllLimbs) {
    std::vector<double> ones{least};
    for (int bit = -1074; bit < 1024; ++bit) ones.push_back(std::ldexp(1.0, bit));
    EXPECT_EQ(value_of(sum_of(ones)), Whole(1) << (1074U + 1024U));
}

TEST(ExactSum, OfSumsIsThatOfTheirLimbsUpToTwoToThe63Addends) {
    const ExactSum half = sum_of(random_doubles(1000, 3));
    const ExactSum other = sum_of(random_doubles(1000, 4));
    auto limbs = half.limbs();
    for (std::size_t i = 0; i < limbs.size(); ++i) limbs[i] += other.limbs()[i];
    EXPECT_EQ(value_of(ExactSum(limbs)), value_of(half) + value_of(other));

    // 2^32 processes, each with 2^31 equal doubles.
    ExactSum many = sum_of({greatest});
    for (const std::uint64_t copies : {std::uint64_t{1} << 31U, std::uint64_t{1} << 32U}) {
        limbs = many.limbs();
        for (std::uint64_t& limb : limbs) limb *= copies;
        many = ExactSum(limbs);
    }
    EXPECT_EQ(value_of(many), value_of(sum_of({greatest})) << 63U);
}

TEST(ExactSum, IsComparedAsNumbersAre) {
    for (const double a : all_sorts) {
        for (const double b : all_sorts) {
            EXPECT_EQ(sum_of({a}) < sum_of({b}), a < b);
            EXPECT_EQ(sum_of({a}) == sum_of({b}), a == b);
            EXPECT_EQ(sum_of({a, least}) <= sum_of({b}), a < b);
        }
    }
}

TEST(ExactSum, SharesAreTheExactOnesRoundedUpToAUnit) {
    std::vector<std::vector<double>> sums{{}, std::vector<double>(1000, greatest)};
    for (const double a : all_sorts) sums.push_back({a});
    for (std::uint64_t seed = 0; seed < 20; ++seed) sums.push_back(random_doubles(10, seed));
    std::vector<double> shares{1,      std::nextafter(1.0, 0), 0.5,  0.1, 0.8, 0x1p-32, 0x1p-54,
                               1e-300, least_normal,           least};
    for (const double any : random_doubles(20, 5)) shares.push_back(any > 1 ? 1 / any : any);
    for (const auto& addends : sums) {
        for (const double share : shares) {
            // Shares are in units of 2^-exact_unit, sums in units of 2^-1074.
            const Whole product = value_of(addends) * exact_value(share);
            const Whole rounded_up = (product + (Whole(1) << exact_unit) - 1) >> exact_unit;
            EXPECT_EQ(value_of(sum_of(addends).share(share)), rounded_up) << share;
        }
    }
}

TEST(RankedSums, AreThoseOfAnyNumberOfTheGreatest) {
    for (const std::size_t count : {0U, 1U, 1023U, 1024U, 1025U, 3000U}) {
        const std::vector<double> indicators = random_doubles(count, count);
        const auto descending = descending_bits(indicators);
        const RankedSums sums(descending);
        ExactSum sum;
        for (std::size_t k = 0; k <= count; ++k) {
            EXPECT_EQ(sums.of_first(k), sum);
            if (k < count) sum.add(std::bit_cast<double>(descending[k]));
        }
    }
}

}  // namespace
}  // namespace octetra::distributed
