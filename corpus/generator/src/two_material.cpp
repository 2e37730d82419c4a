#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/generator/solids.hpp>

#include "icosphere.hpp"
#include "parameters.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {
namespace {

void check(double inclusion_radius, double edge_length) {
    check_length(inclusion_radius, "the inclusion's radius");
    check_length(edge_length, "the edge length");
    const double gap = 0.5 - inclusion_radius;
    if (gap <= 0) {
        throw InputError(fmt::format("the inclusion's radius should be less than 0.5, not {}",
                                     inclusion_radius));
    }
    check_cell_estimate(1, std::min({edge_length, inclusion_radius, gap}));
}

/// Adds the unit cube; corner number 4z + 2y + x.
void add_cube(Complex& complex) {
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        complex.add({static_cast<double>(corner & 1U), static_cast<double>(corner >> 1U & 1U),
                     static_cast<double>(corner >> 2U)});
    }
    for (const std::uint32_t across : {1U, 2U, 4U}) {
        const std::uint32_t u = across == 4 ? 1 : 2 * across;
        const std::uint32_t v = 7 - across - u;
        for (const std::uint32_t low : {0U, across}) {
            complex.facets.push_back({.polygons = {{low, low + u, low + u + v, low + v}}});
        }
        for (const std::uint32_t beside : {0U, u, v, u + v}) {
            complex.ridges.push_back({beside, beside + across, 1});
        }
    }
}

}  // namespace

Mesh two_material(double inclusion_radius, double edge_length) {
    check(inclusion_radius, edge_length);
    Complex complex;
    add_cube(complex);
    const Point centre{0.5, 0.5, 0.5};
    add_icosphere(complex, centre, inclusion_radius,
                  icosphere_frequency(inclusion_radius, edge_length), 2);
    // Halfway between the ball and a corner of the cube.
    const double outside = (0.5 - inclusion_radius / std::numbers::sqrt3) / 2;
    complex.regions = {{{outside, outside, outside}, 1}, {centre, 2}};
    return fill(complex, edge_length, Surface::may_be_cut);
}

}  // namespace octetra::generator
