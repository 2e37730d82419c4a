#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

/// Solids that TetGen fills with cells of good quality (without TetGen, InputError is thrown).
///
/// Properties: numbers count from 0; every cell is positively oriented, exactly; the facets are
/// those of the boundary and of interfaces, each listed once. The order of a facet's corners is not
/// defined.
/// All lengths have the same unit, and must be from 1e-30 to 1e30. No cell is larger than a regular
/// cell with the given edge length, except near the surfaces of sphere() and torus(), which TetGen
/// must not modify; cells are smaller where the solid is thin. InputError is thrown for a solid
/// that would need more than about 100 million cells, and for impossible ones.
namespace octetra::generator {

/// A ball around the origin, bounded by an icosahedron whose sides are divided into f^2 triangles
/// and projected onto the sphere, where f = ceil(1.0514622 radius / edge_length). The surface is
/// not modified: 20f^2 facets, marker 1, with all their 10f^2 + 2 vertices on the sphere.
[[nodiscard]] Mesh sphere(double radius = 1, double edge_length = 0.3);

/// A torus around the z axis: a tube of radius `minor_radius` around a circle of radius
/// `major_radius`, which must be larger. The surface is a grid of a x b quadrangles of two
/// triangles each, and is not modified: 2ab facets, marker 1, where a = max(3, ceil(2 pi
/// major_radius / edge_length)) and b = max(3, ceil(2 pi minor_radius / edge_length)).
[[nodiscard]] Mesh torus(double major_radius = 1, double minor_radius = 0.4,
                         double edge_length = 0.25);

/// The cube [-1, 1]^3 without the octant of positive x, y and z (Fichera's corner), for which
/// solutions are singular at the re-entrant corner, the origin. Volume 7.
/// Facet markers: 1 outer faces, 2 the three re-entrant ones.
/// Tagged edges: the ridges, marker 1, and the three re-entrant ones that end at the origin, 2.
[[nodiscard]] Mesh fichera(double edge_length = 0.5);

/// A gear around the z axis, from z = 0 to `thickness`.
struct Gear {
    std::uint64_t teeth = 12;  ///< 3 to 1000
    double outer_radius = 1;   ///< radius of the tips; that of the roots is 4/5 of it
    double thickness = 0.3;
    double bore_radius = 0.3;  ///< less than the distance of the roots' chords from the axis
    double edge_length = 0.2;
};

/// The outline is a polygon with trapezoidal teeth: the tip takes a quarter of each tooth's part of
/// the circle, the base three fifths. The bore is an inscribed polygon of max(8, ceil(2 pi
/// bore_radius / edge_length)) sides.
/// Facet markers: 1 top and bottom, 2 the teeth's flanks and the rim, 3 the bore.
/// Tagged edges: 1 the outline at top and bottom, 2 the vertical edges of teeth, 3 the bore's rims.
[[nodiscard]] Mesh gear(const Gear& gear = {});

/// The unit cube with a ball of another material around its centre. The ball's surface is initially
/// that of sphere(); TetGen may insert vertices on its triangles.
/// Region tags: 1 outside, 2 in the ball. Facet markers: 1 the cube's surface, 2 the interface.
/// Tagged edges: those of the cube, marker 1. The inclusion's radius must be less than 0.5.
[[nodiscard]] Mesh two_material(double inclusion_radius = 0.3, double edge_length = 0.2);

}  // namespace octetra::generator
