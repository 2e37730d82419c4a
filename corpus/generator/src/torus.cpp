#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/generator/solids.hpp>

#include "circle.hpp"
#include "parameters.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {
namespace {

void check(double major_radius, double minor_radius, double edge_length) {
    check_length(major_radius, "the major radius");
    check_length(minor_radius, "the minor radius");
    check_length(edge_length, "the edge length");
    if (minor_radius >= major_radius) {
        throw InputError(
            fmt::format("the minor radius should be less than the major one, {}, not {}",
                        major_radius, minor_radius));
    }
    const double pi = std::numbers::pi;
    check_cell_estimate(2 * pi * pi * major_radius * minor_radius * minor_radius,
                        std::min({edge_length, minor_radius, major_radius - minor_radius}));
}

}  // namespace

Mesh torus(double major_radius, double minor_radius, double edge_length) {
    check(major_radius, minor_radius, edge_length);
    const std::uint32_t along = circle_parts(major_radius, edge_length, 3);
    const std::uint32_t around = circle_parts(minor_radius, edge_length, 3);
    Complex complex;
    for (std::uint32_t i = 0; i < along; ++i) {
        const Direction u = direction(i, along);
        for (std::uint32_t j = 0; j < around; ++j) {
            const Direction v = direction(j, around);
            const double distance = major_radius + minor_radius * v.cos;
            complex.add({distance * u.cos, distance * u.sin, minor_radius * v.sin});
        }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return (i % along) * around + j % around;
    };
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            const std::uint32_t diagonal_end = at(i + 1, j + 1);
            complex.facets.push_back({.polygons = {{at(i, j), at(i + 1, j), diagonal_end}}});
            complex.facets.push_back({.polygons = {{at(i, j), diagonal_end, at(i, j + 1)}}});
        }
    }
    return fill(complex, edge_length, Surface::as_given);
}

}  // namespace octetra::generator
