#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

/// Solids that TetGen fills with cells of good quality (without TetGen they throw InputError).
///
/// Laws: numbers count from 0; every cell is positively oriented, exactly; the facets are the
/// boundary's faces, each once, and an interface's where the solid has one. The order of a facet's
/// corners means nothing.
/// All lengths are in one unit, and from 1e-30 to 1e30. No cell is larger than a regular cell of
/// the edge length given, except near the surfaces of sphere() and torus(), which TetGen must keep
/// as they are; cells are smaller where the solid is thin. A solid that would take more than about
/// 100 million cells is refused, as is every impossible one, by an InputError.
namespace octetra::generator {

/// A ball about the origin, bounded by an icosahedron whose sides are cut into f^2 triangles and
/// blown up onto the sphere, where f = ceil(1.0514622 radius / edge_length). The surface stays as
/// it is: 20f^2 facets, marker 1, with all their 10f^2 + 2 vertices on the sphere.
[[nodiscard]] Mesh sphere(double radius = 1, double edge_length = 0.3);

/// A ring round the z axis: a tube of radius `minor_radius` about a circle of `major_radius`, which
/// should be the greater. The surface is a grid of a x b quadrangles in two triangles each, and
/// stays so: 2ab facets, marker 1, where a = max(3, ceil(2 pi major_radius / edge_length)) and
/// b = max(3, ceil(2 pi minor_radius / edge_length)).
[[nodiscard]] Mesh torus(double major_radius = 1, double minor_radius = 0.4,
                         double edge_length = 0.25);

/// The cube [-1, 1]^3 without the octant where x, y and z are positive (Fichera's corner), whose
/// solutions are singular at the re-entrant corner, the origin. Volume 7.
/// Facet markers: 1 outer faces, 2 the three re-entrant ones.
/// Tagged edges: the ridges, marker 1, and the three re-entrant ones that end at the origin, 2.
[[nodiscard]] Mesh fichera(double edge_length = 0.5);

/// A gear about the z axis, from z = 0 to `thickness`.
struct Gear {
    std::uint64_t teeth = 12;  ///< 3 to 1000
    double outer_radius = 1;   ///< where the tips are; the roots are at 4/5 of it
    double thickness = 0.3;
    double bore_radius = 0.3;  ///< less than the roots' chords are away from the axis
    double edge_length = 0.2;
};

/// The outline is a polygon with trapezoidal teeth: of each tooth's share of the circle the tip
/// takes a quarter, the base three fifths. The bore is an inscribed polygon of
/// max(8, ceil(2 pi bore_radius / edge_length)) sides.
/// Facet markers: 1 top and bottom, 2 the teeth's flanks and the rim, 3 the bore.
/// Tagged edges: 1 the outline at top and bottom, 2 the upright edges of teeth, 3 the bore's rims.
[[nodiscard]] Mesh gear(const Gear& gear = {});

/// The unit cube with a ball of another material about its centre. The ball's surface starts as
/// that of sphere(); TetGen may put further vertices on its triangles.
/// Region tags: 1 outside, 2 in the ball. Facet markers: 1 the cube's surface, 2 the interface.
/// Tagged edges: the cube's, marker 1. The inclusion's radius should be less than 0.5.
[[nodiscard]] Mesh two_material(double inclusion_radius = 0.3, double edge_length = 0.2);

}  // namespace octetra::generator
