#pragma once

#include <cstdint>

#include "complex.hpp"

namespace octetra::generator {

/// Into how many parts the edges of an icosahedron of this radius must be cut to be no longer than
/// `edge_length`.
[[nodiscard]] std::uint32_t icosphere_frequency(double radius, double edge_length);

/// Adds a sphere: an icosahedron, each side cut into frequency^2 triangles, its points moved out
/// along their rays. 10 frequency^2 + 2 points, 20 frequency^2 facets.
void add_icosphere(Complex& complex, const Point& centre, double radius, std::uint32_t frequency,
                   Marker marker);

}  // namespace octetra::generator
