#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

/// Lattices: meshes of congruent or nearly congruent cells.
///
/// Properties of all meshes here: numbers count from 0; every cell is positively oriented, exactly;
/// every boundary face is listed once as a facet, with its corners counterclockwise as seen from
/// outside. Lengths are in the unit of `size` or `scale`, which must be from 1e-30 to 1e30. Counts
/// must be at least 1, and small enough that vertices, cells and facets can be numbered with 32
/// bits. Otherwise InputError is thrown.
namespace octetra::generator {

/// The extent of a box along each axis.
struct Size {
    double x = 1;
    double y = 1;
    double z = 1;
};

/// The box [0, size.x] x [0, size.y] x [0, size.z] divided into nx x ny x nz bricks, each of 6
/// cells around the diagonal from its low to its high corner (Kuhn 1960; also called
/// Freudenthal's).
///  - Vertex (i, j, k) has the number (k (ny+1) + j) (nx+1) + i and the coordinates
///    (i*size.x)/nx, (j*size.y)/ny, (k*size.z)/nz, rounded after each of the two operations.
///  - The cells of brick (i, j, k) are 6 ((k ny + j) nx + i) and the next five.
///  - Facet markers: 1 and 2 at the low and high end of x, 3 and 4 of y, 5 and 6 of z.
/// Counts: (nx+1)(ny+1)(nz+1) vertices, 6 nx ny nz cells, 4 (nx ny + ny nz + nz nx) facets.
[[nodiscard]] Mesh kuhn(std::uint64_t nx, std::uint64_t ny, std::uint64_t nz,
                        const Size& size = {});

/// The cube [0, size]^3 divided into n^3 cubes with a vertex at the centre of each. Around every
/// segment between the centres of two neighbours there are four cells, one for each edge of the
/// square between them (Sommerville 1923). A boundary square has a vertex at its centre instead of
/// the missing neighbour, so the four cells there are halved and the cube is filled.
///  - Vertices: first the corners, numbered as in kuhn(n, n, n), then the centres, x fastest, then
///    those in boundary squares. Coordinates are (h*size)/(2n) for whole h.
///  - Facet markers as in kuhn().
/// Counts: (n+1)^3 + n^3 + 6n^2 vertices, 12n^3 + 12n^2 cells, 24n^2 facets, and thus
/// 14n^3 + 33n^2 + 3n edges.
[[nodiscard]] Mesh bcc(std::uint64_t n, double size = 1);

/// A single regular cell, inscribed in the cube [-scale, scale]^3: edges of length scale * sqrt(8).
/// Facet i is opposite vertex i and has the marker i+1.
[[nodiscard]] Mesh regular(double scale = 1);

}  // namespace octetra::generator
