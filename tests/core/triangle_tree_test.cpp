#include <octetra/core/triangle_tree.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace octetra {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}
    Point point() { return {number(), number(), number()}; }
    /// A triangle of any size, sometimes flat.
    Triangle triangle() {
        const Point a = point();
        const double size = std::pow(10, -4 * std::abs(number()));
        const auto near_a = [&] {
            return Point{a.x + size * number(), a.y + size * number(), a.z + size * number()};
        };
        Triangle t{a, near_a(), near_a()};
        if (random_() % 10 == 0) t[2] = midpoint(t[0], t[1]);
        if (random_() % 30 == 0) t[1] = t[0];
        return t;
    }

private:
    double number() { return place_(random_); }
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> place_{-0.5, 0.5};
};

/// The distance to points of a grid of barycentric coordinates, around the best of which the grid
/// is made finer.
double distance_by_search(const Point& p, const Triangle& t) {
    double s0 = 0.5;
    double t0 = 0.5;
    double best = infinity;
    double size = 0.5;
    for (int round = 0; round < 60; ++round) {
        double next_s = s0;
        double next_t = t0;
        for (int i = -4; i <= 4; ++i) {
            for (int j = -4; j <= 4; ++j) {
                double u = std::clamp(s0 + i * size / 4, 0.0, 1.0);
                double v = std::clamp(t0 + j * size / 4, 0.0, 1.0);
                if (u + v > 1) {  // to the third edge
                    const double excess = (u + v - 1) / 2;
                    u = std::clamp(u - excess, 0.0, 1.0);
                    v = 1 - u;
                }
                const auto coordinate = [&](double Point::*c) {
                    return t[0].*c + u * (t[1].*c - t[0].*c) + v * (t[2].*c - t[0].*c) - p.*c;
                };
                const double d =
                    std::hypot(coordinate(&Point::x), coordinate(&Point::y), coordinate(&Point::z));
                if (d < best) {
                    best = d;
                    next_s = u;
                    next_t = v;
                }
            }
        }
        s0 = next_s;
        t0 = next_t;
        size *= 0.7;
    }
    return best;
}

TEST(TriangleDistance, IsThatToTheClosestPoint) {
    Draw draw(1);
    for (int i = 0; i < 1000; ++i) {
        const Triangle triangle = draw.triangle();
        const Point p = draw.point();
        const double squared = squared_distance(p, triangle);
        EXPECT_NEAR(std::sqrt(squared), distance_by_search(p, triangle), 1e-6) << "case " << i;
    }
}

TEST(TriangleDistance, IsZeroAtTheTriangle) {
    Draw draw(2);
    for (int i = 0; i < 1000; ++i) {
        const Triangle t = draw.triangle();
        const Point inside = midpoint(midpoint(t[0], t[1]), t[2]);
        EXPECT_LT(squared_distance(inside, t), 1e-30);
        for (const Point& corner : t) EXPECT_EQ(squared_distance(corner, t), 0);
    }
}

TEST(TriangleTree, FindsTheLeastDistanceBitByBit) {
    Draw draw(3);
    for (const std::size_t count :
         std::initializer_list<std::size_t>{0, 1, 7, 8, 9, 17, 100, 1000}) {
        std::vector<Triangle> triangles;
        for (std::size_t i = 0; i < count; ++i) triangles.push_back(draw.triangle());
        const TriangleTree tree(triangles);
        for (Triangle& t : triangles) std::ranges::sort(t);
        for (int i = 0; i < 300; ++i) {
            const Point p = draw.point();
            double least = infinity;
            for (const Triangle& t : triangles) least = std::min(least, squared_distance(p, t));
            EXPECT_EQ(tree.least_squared_distance(p), least);
            EXPECT_EQ(tree.least_squared_distance(p, 0.01), std::min(least, 0.01));
        }
    }
}

/// The triangles of a sphere around the origin, of about the same size.
std::vector<Triangle> sphere_of_triangles(double radius, int divisions) {
    const auto on_sphere = [&](double x, double y, double z) {
        const double length = std::hypot(x, y, z);
        return Point{radius * x / length, radius * y / length, radius * z / length};
    };
    std::vector<Triangle> triangles;
    const auto corner = [&](int face, int i, int j) {
        const double u = std::tan((2.0 * i / divisions - 1) * 0.785);
        const double v = std::tan((2.0 * j / divisions - 1) * 0.785);
        const double side = face % 2 == 0 ? 1 : -1;
        if (face / 2 == 0) return on_sphere(side, u, v);
        return face / 2 == 1 ? on_sphere(u, side, v) : on_sphere(u, v, side);
    };
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < divisions; ++i) {
            for (int j = 0; j < divisions; ++j) {
                const Point a = corner(face, i, j);
                const Point b = corner(face, i + 1, j + 1);
                triangles.push_back({a, corner(face, i + 1, j), b});
                triangles.push_back({b, a, corner(face, i, j + 1)});
            }
        }
    }
    return triangles;
}

/// A point whose distance from the origin is about `size`.
Point point_near_origin(Draw& draw, double size) {
    const Point p = draw.point();
    return {size * p.x, size * p.y, size * p.z};
}

TEST(TriangleTree, FindsTheLeastOfNearlyEqualDistancesBitByBit) {
    Draw draw(5);
    for (const double radius : {0.4, 1e-9, 1e-76, 1e-80, 1e-160, 1e-310}) {
        std::vector<Triangle> triangles = sphere_of_triangles(radius, 8);
        const TriangleTree tree(triangles);
        for (Triangle& t : triangles) std::ranges::sort(t);
        for (int i = 0; i < 200; ++i) {
            const Point p = i % 2 == 0 ? draw.point() : point_near_origin(draw, radius / 4);
            double least = infinity;
            for (const Triangle& t : triangles) least = std::min(least, squared_distance(p, t));
            EXPECT_EQ(tree.least_squared_distance(p), least) << radius;
        }
    }
}

TEST(TriangleTree, FindsTinyTrianglesThatAreALittleCloserThanOthers) {
    const Triangle large{Point{-0.5, -0.5, 0.5}, Point{1, -0.5, 0.5}, Point{0.25, 0.5, 0.5}};
    const Point p{0, 0, 0.249};
    for (double size = 1e-75; size > 1e-85; size *= 0.7) {  // the squares of areas are denormal
        std::vector<Triangle> triangles(8, large);
        const Triangle tiny{Point{0, 0, 0}, Point{size, 0, 0}, Point{0, size, 0}};
        triangles.insert(triangles.end(), 8, tiny);
        EXPECT_EQ(TriangleTree(triangles).least_squared_distance(p), squared_distance(p, tiny))
            << size;
    }
}

TEST(TriangleTree, TestsFewOfTheTrianglesThatAreNearlyEquallyClose) {
    struct BoxOf {
        Box operator()(const Triangle& t) const {
            Box box{t[0], t[0]};
            for (const Point& p : t) extend_by(box, {p, p});
            return box;
        }
    };
    const std::vector<Triangle> triangles = sphere_of_triangles(0.4, 40);
    const auto tests_of = [](const auto& tree) {
        Draw draw(6);
        std::size_t tests = 0;
        for (int i = 0; i < 200; ++i) {
            const Point p = point_near_origin(draw, 0.2);
            double limit = infinity;
            tree.visit_near(p, limit, [&](const Triangle& t) {
                limit = std::min(limit, limit_of_boxes(squared_distance(p, t)));
                ++tests;
            });
        }
        return tests;
    };
    const BoxTree<Triangle, BoxOf> of_boxes(triangles);
    const BoxTree<Triangle, BoxOf, Slab> of_slabs(triangles);
    EXPECT_LT(20 * tests_of(of_slabs), tests_of(of_boxes));
}

TEST(TriangleTree, HasBoxesAroundAllTriangles) {
    Draw draw(4);
    for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 5, 40, 1000}) {
        std::vector<Triangle> triangles;
        for (std::size_t i = 0; i < count; ++i) triangles.push_back(draw.triangle());
        const TriangleTree tree(triangles);
        for (const std::size_t most : std::initializer_list<std::size_t>{1, 2, 7, 64}) {
            const std::vector<Box> boxes = tree.boxes(most);
            EXPECT_LE(boxes.size(), most);
            for (const Triangle& t : triangles) {
                EXPECT_TRUE(std::ranges::any_of(boxes, [&](const Box& box) {
                    return std::ranges::all_of(
                        t, [&](const Point& p) { return least_squared_distance(p, box) == 0; });
                }));
            }
        }
    }
}

}  // namespace
}  // namespace octetra
