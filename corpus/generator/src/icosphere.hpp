#pragma once

#include <cstdint>

#include "complex.hpp"

namespace octetra::generator {

/// Returns the number of parts into which the edges of an icosahedron of this radius must be
/// divided to be no longer than `edge_length`.
[[nodiscard]] std::uint32_t icosphere_frequency(double radius, double edge_length);

/// Adds a sphere: an icosahedron with each side divided into frequency^2 triangles, whose points
/// are projected radially. 10 frequency^2 + 2 points, 20 frequency^2 facets.
void add_icosphere(Complex& complex, const Point& centre, double radius, std::uint32_t frequency,
                   Marker marker);

}  // namespace octetra::generator
