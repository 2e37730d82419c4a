#include "properties/world_search.hpp"

#include <gtest/gtest.h>

#include <octetra/verify/verify.hpp>

#include "properties/draw.hpp"
#include "properties/small_complexes.hpp"
#include "support/meshes.hpp"

namespace octetra::properties {
namespace {

std::vector<Point> points_below(std::size_t extent, std::size_t count, Draw& draw) {
    std::vector<Point> points(count);
    for (Point& p : points) {
        for (double* x : {&p.x, &p.y, &p.z}) *x = static_cast<double>(draw.below(extent));
    }
    return points;
}

bool is_found_valid(const Complex& complex, const std::vector<Point>& points) {
    return verify::verify_mesh(test::mesh_of(points, complex)).valid();
}

/// Random corners in a cube of 2^20: no four are expected in a plane.
TEST(WorldSearch, AgreesWithTheVerifierOnRandomCorners) {
    Draw draw(1);
    for (const Complex& complex : all_small_complexes()) {
        for (int i = 0; i < 1000; ++i) {
            const auto points = points_below(1U << 20U, vertex_count(complex), draw);
            ASSERT_EQ(is_valid(points, complex), is_found_valid(complex, points));
        }
    }
}

/// Random corners in a cube of 8: many lie in a plane.
TEST(WorldSearch, AcceptsNothingThatTheVerifierRefuses) {
    Draw draw(1);
    std::size_t valid = 0;
    for (const Complex& complex : all_small_complexes()) {
        for (int i = 0; i < 1000; ++i) {
            const auto points = points_below(8, vertex_count(complex), draw);
            if (!is_valid(points, complex)) continue;
            ASSERT_TRUE(is_found_valid(complex, points));
            ++valid;
        }
    }
    EXPECT_GT(valid, 500U);
}

}  // namespace
}  // namespace octetra::properties
