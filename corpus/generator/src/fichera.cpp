#include <algorithm>
#include <array>

#include <octetra/generator/solids.hpp>

#include "parameters.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {
namespace {

/// Decodes a number in base 3 with a digit 0, 1 or 2 for each coordinate -1, 0 or 1, the last one
/// for x.
Point lattice_point(std::uint32_t code) {
    const std::uint32_t x = code % 3;
    const std::uint32_t y = code / 3 % 3;
    const std::uint32_t z = code / 9;
    return {static_cast<double>(x) - 1, static_cast<double>(y) - 1, static_cast<double>(z) - 1};
}

struct Corners {
    Marker marker;
    Polygon codes;
};

constexpr std::uint32_t origin = 13;

const std::array<Corners, 9> faces{{{1, {0, 2, 8, 6}},
                                    {1, {0, 2, 20, 18}},
                                    {1, {0, 6, 24, 18}},
                                    {1, {2, 8, 17, 14, 23, 20}},
                                    {1, {6, 8, 17, 16, 25, 24}},
                                    {1, {18, 20, 23, 22, 25, 24}},
                                    {2, {origin, 14, 17, 16}},
                                    {2, {origin, 14, 23, 22}},
                                    {2, {origin, 16, 25, 22}}}};

/// Adds the edges of a polygon that are not in the complex yet.
void add_ridges(Complex& complex, const Polygon& polygon) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::uint32_t a = polygon[k];
        const std::uint32_t b = polygon[(k + 1) % polygon.size()];
        const bool known = std::ranges::any_of(complex.ridges, [&](const Ridge& ridge) {
            return (ridge.from == a && ridge.to == b) || (ridge.from == b && ridge.to == a);
        });
        if (known) continue;
        const bool re_entrant = complex.points[a] == Point{} || complex.points[b] == Point{};
        complex.ridges.push_back({a, b, re_entrant ? 2 : 1});
    }
}

}  // namespace

Mesh fichera(double edge_length) {
    check_length(edge_length, "the edge length");
    check_cell_estimate(7, edge_length);
    constexpr std::uint32_t unused = 27;
    std::array<std::uint32_t, 27> numbers{};
    numbers.fill(unused);
    Complex complex;
    for (const Corners& face : faces) {
        Polygon polygon;
        for (const std::uint32_t code : face.codes) {
            if (numbers[code] == unused) numbers[code] = complex.add(lattice_point(code));
            polygon.push_back(numbers[code]);
        }
        add_ridges(complex, polygon);
        complex.facets.push_back({.polygons = {polygon}, .marker = face.marker});
    }
    return fill(complex, edge_length, Surface::may_be_cut);
}

}  // namespace octetra::generator
