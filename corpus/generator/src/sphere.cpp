#include <algorithm>
#include <numbers>

#include <octetra/generator/solids.hpp>

#include "icosphere.hpp"
#include "parameters.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {

Mesh sphere(double radius, double edge_length) {
    check_length(radius, "the radius");
    check_length(edge_length, "the edge length");
    check_cell_estimate(4 * std::numbers::pi / 3 * radius * radius * radius, edge_length);
    Complex complex;
    add_icosphere(complex, {0, 0, 0}, radius, icosphere_frequency(radius, edge_length), 1);
    return fill(complex, edge_length, Surface::as_given);
}

}  // namespace octetra::generator
