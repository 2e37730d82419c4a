#include "partition/rcb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <random>
#include <span>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace octetra::distributed {
namespace {

double along(std::size_t axis, const Point& p) { return std::array{p.x, p.y, p.z}[axis]; }

/// Reference by sorting: the first half of a box gets points in the order of coordinates and
/// numbers until they exceed its share of the weight.
void bisect_by_sorting(std::span<WeighedPoint> points, int begin, int end, std::vector<int>& part) {
    if (end - begin == 1) {
        for (const WeighedPoint& one : points) part[one.number / 3] = begin;
        return;
    }
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3 && !points.empty(); ++k) {
        const auto [least, most] =
            std::ranges::minmax(points, {}, [&](const auto& one) { return along(k, one.point); });
        extent[k] = along(k, most.point) / 2 - along(k, least.point) / 2;
    }
    const double enough = std::ranges::max(extent) * (63.0 / 64);
    const std::size_t axis = extent[2] >= enough ? 2 : extent[1] >= enough ? 1 : 0;
    std::ranges::sort(points, {}, [&](const WeighedPoint& one) {
        return std::tuple(along(axis, one.point), one.number);
    });
    std::uint64_t left = 0;
    for (const WeighedPoint& one : points) left += one.weight;
    const int middle = begin + (end - begin) / 2;
    left =
        left * static_cast<std::uint64_t>(middle - begin) / static_cast<std::uint64_t>(end - begin);
    std::size_t first = 0;
    while (first < points.size() && points[first].weight <= left) left -= points[first++].weight;
    bisect_by_sorting(points.first(first), begin, middle, part);
    bisect_by_sorting(points.subspan(first), middle, end, part);
}

/// Numbers are in steps of three.
void expect_as_by_sorting(const std::vector<WeighedPoint>& points,
                          std::initializer_list<int> numbers_of_parts = {1, 2, 3, 5, 8, 40}) {
    for (const int parts : numbers_of_parts) {
        const auto found = bisect_coordinates(Communicator(), points, parts);
        std::vector<WeighedPoint> sorted = points;
        std::vector<int> expected(points.size());
        bisect_by_sorting(sorted, 0, parts, expected);
        ASSERT_EQ(found, expected) << points.size() << " points, " << parts << " parts";
    }
}

std::vector<WeighedPoint> points_of(std::size_t count, auto&& coordinate, auto&& weight) {
    std::vector<WeighedPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Point at{coordinate(), coordinate(), coordinate()};
        points.push_back({.point = at, .number = 3 * i, .weight = weight()});
    }
    return points;
}

constexpr auto one = [] { return std::uint64_t{1}; };

TEST(CoordinateBisection, CutsWhereSortingWould) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> anywhere(-1, 2);
    const auto coordinate = [&] { return anywhere(random); };
    const auto weight = [&] { return std::uint64_t{1} << random() % 30U; };
    for (const std::size_t count : {0U, 1U, 2U, 7U, 300U, 5000U}) {
        expect_as_by_sorting(points_of(count, coordinate, one));
        expect_as_by_sorting(points_of(count, coordinate, weight));
    }
}

TEST(CoordinateBisection, BreaksTiesOfCoordinatesByNumbers) {
    std::mt19937_64 random(2);
    const auto weight = [&] { return 1 + random() % 5; };
    expect_as_by_sorting(points_of(
        1000, [] { return 0.25; }, weight));
    expect_as_by_sorting(points_of(
        3000, [&] { return static_cast<double>(random() % 4); }, weight));
    expect_as_by_sorting(points_of(
        500, [&] { return random() % 2 == 0 ? 0.0 : -0.0; }, one));
}

/// More points than processes exchange individually.
TEST(CoordinateBisection, BreaksTiesOfManyPointsByNumbers) {
    std::mt19937_64 random(4);
    const auto coordinate = [&] { return static_cast<double>(random() % 3); };
    expect_as_by_sorting(points_of(40'000, coordinate, one), {2, 3, 7});
    expect_as_by_sorting(points_of(40'000, coordinate, [&] { return random() % 3; }), {2, 7, 50});
}

/// More boxes than are given many sums each.
TEST(CoordinateBisection, MakesThousandsOfParts) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> anywhere(0, 1);
    const auto coordinate = [&] { return anywhere(random); };
    const auto lattice = [&] { return static_cast<double>(random() % 20); };
    expect_as_by_sorting(points_of(9'000, coordinate, one), {1'500, 6'001, 20'000});
    expect_as_by_sorting(points_of(30'000, lattice, one), {1'500, 6'001, 16'385, 20'000});
}

TEST(CoordinateBisection, TakesCoordinatesOfAnySize) {
    std::mt19937_64 random(3);
    const auto coordinate = [&] {
        constexpr std::array some{-1.7e308, -1e-320, -5e-324, -0.0, 0.0, 5e-324, 1e-310, 1.7e308};
        return random() % 2 == 0 ? some[random() % some.size()]
                                 : std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
    };
    expect_as_by_sorting(points_of(2000, coordinate, one));
}

/// Parts equal those of one process even if the axis estimated from a sample differs from that of
/// all points.
TEST(CoordinateBisection, FindsAnAxisThatFewPointsDetermine) {
    auto points = points_of(
        100'000, [] { return 0.0; }, one);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].point.x = static_cast<double>(i);
    points[77'777].point.z = 1e6;
    expect_as_by_sorting(points);
}

/// So a process that reads a block of a lattice keeps the cells that it has read.
TEST(CoordinateBisection, CutsACubeBetweenItsLastLayers) {
    std::vector<WeighedPoint> points;
    for (std::uint64_t i = 0; i < 512; ++i) {
        const auto at = [&](std::uint64_t k) { return static_cast<double>(k % 8) / 7; };
        points.push_back({.point = {1.01 * at(i), at(i / 8), at(i / 64)}, .number = i});
    }
    const auto parts = bisect_coordinates(Communicator(), points, 2);
    EXPECT_TRUE(std::ranges::is_sorted(parts));
    EXPECT_EQ(std::ranges::count(parts, 0), 256);
}

}  // namespace
}  // namespace octetra::distributed
