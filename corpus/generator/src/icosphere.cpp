#include "icosphere.hpp"

#include <array>
#include <cmath>
#include <map>

namespace octetra::generator {
namespace {

/// A point of the icosahedron: up to three corners with integer weights whose sum is the frequency.
/// Corners of weight 0 are omitted, so that sides sharing a point have the same name for it.
using Name = std::map<std::uint32_t, std::uint32_t>;

constexpr double golden = 1.6180339887498949;

constexpr std::array<Point, 12> corners{{{-1, golden, 0},
                                         {1, golden, 0},
                                         {-1, -golden, 0},
                                         {1, -golden, 0},
                                         {0, -1, golden},
                                         {0, 1, golden},
                                         {0, -1, -golden},
                                         {0, 1, -golden},
                                         {golden, 0, -1},
                                         {golden, 0, 1},
                                         {-golden, 0, -1},
                                         {-golden, 0, 1}}};

constexpr std::array<std::array<std::uint32_t, 3>, 20> sides{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

class Icosphere {
public:
    Icosphere(Complex& complex, const Point& centre, double radius)
        : complex_(&complex), centre_(centre), radius_(radius) {}

    /// Returns the number of a point, which is created on first use.
    std::uint32_t number(const Name& name) {
        const auto [entry, is_new] = numbers_.try_emplace(name, 0);
        if (is_new) entry->second = complex_->add(position(name));
        return entry->second;
    }

private:
    [[nodiscard]] Point position(const Name& name) const {
        Point sum;
        for (const auto& [corner, weight] : name) {
            sum.x += weight * corners[corner].x;
            sum.y += weight * corners[corner].y;
            sum.z += weight * corners[corner].z;
        }
        const double scale = radius_ / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
        return {centre_.x + scale * sum.x, centre_.y + scale * sum.y, centre_.z + scale * sum.z};
    }

    Complex* complex_;
    Point centre_;
    double radius_;
    std::map<Name, std::uint32_t> numbers_;
};

}  // namespace

std::uint32_t icosphere_frequency(double radius, double edge_length) {
    constexpr double icosahedron_edge = 1.0514622;  // of an icosahedron in the unit sphere
    return static_cast<std::uint32_t>(std::ceil(icosahedron_edge * radius / edge_length));
}

void add_icosphere(Complex& complex, const Point& centre, double radius, std::uint32_t frequency,
                   Marker marker) {
    Icosphere sphere(complex, centre, radius);
    for (const auto& side : sides) {
        // Returns the point i steps from corner 0 towards corner 1, and j steps towards corner 2.
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            Name name;
            if (i + j < frequency) name[side[0]] = frequency - i - j;
            if (i > 0) name[side[1]] = i;
            if (j > 0) name[side[2]] = j;
            return sphere.number(name);
        };
        const auto add_facet = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            complex.facets.push_back({.polygons = {{a, b, c}}, .marker = marker});
        };
        for (std::uint32_t i = 0; i < frequency; ++i) {
            for (std::uint32_t j = 0; i + j < frequency; ++j) {
                // Points are numbered here. Separate statements, because the evaluation order of
                // function arguments, and thus the numbering, would depend on the compiler.
                const std::uint32_t right = at(i, j + 1);
                const std::uint32_t left = at(i + 1, j);
                const std::uint32_t near = at(i, j);
                add_facet(near, left, right);
                if (i + j + 1 == frequency) continue;
                const std::uint32_t far = at(i + 1, j + 1);
                add_facet(left, far, right);
            }
        }
    }
}

}  // namespace octetra::generator
