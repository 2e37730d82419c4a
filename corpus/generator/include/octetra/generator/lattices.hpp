#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

/// Meshes that follow a pattern, of congruent or nearly congruent cells.
///
/// Laws, for every mesh here: numbers count from 0; every cell is positively oriented, exactly;
/// every boundary face is listed once as a facet, its corners counterclockwise seen from outside.
/// Lengths are in the unit of the `size` or `scale` given, which should be from 1e-30 to 1e30.
/// Counts should be at least 1, and so small that 32 bits number every vertex, cell and facet.
/// All else throws InputError.
namespace octetra::generator {

/// How long a box is along each axis.
struct Size {
    double x = 1;
    double y = 1;
    double z = 1;
};

/// The box [0, size.x] x [0, size.y] x [0, size.z] cut into nx x ny x nz bricks, each of 6 cells
/// round the diagonal from its low to its high corner (Kuhn 1960; also called Freudenthal's).
///  - Vertex (i, j, k) has the number (k (ny+1) + j) (nx+1) + i and the coordinates
///    (i*size.x)/nx, (j*size.y)/ny, (k*size.z)/nz, rounded after each of the two operations.
///  - The cells of brick (i, j, k) are 6 ((k ny + j) nx + i) and the five that follow.
///  - Facet markers: 1 and 2 at the low and high end of x, 3 and 4 of y, 5 and 6 of z.
/// Counts: (nx+1)(ny+1)(nz+1) vertices, 6 nx ny nz cells, 4 (nx ny + ny nz + nz nx) facets.
[[nodiscard]] Mesh kuhn(std::uint64_t nx, std::uint64_t ny, std::uint64_t nz,
                        const Size& size = {});

/// The cube [0, size]^3 cut into n^3 cubes with a vertex in the centre of each. Round every segment
/// that joins the centres of two neighbours lie four cells, one to each edge of the square between
/// them (Sommerville 1923). A boundary square has a vertex at its centre instead of the missing
/// neighbour, so that the four cells there are halves and the cube is filled.
///  - Vertices: first the corners, numbered as in kuhn(n, n, n), then the centres, x fastest, then
///    those in boundary squares. Coordinates are (h*size)/(2n) for whole h.
///  - Facet markers as in kuhn().
/// Counts: (n+1)^3 + n^3 + 6n^2 vertices, 12n^3 + 12n^2 cells, 24n^2 facets, and so
/// 14n^3 + 33n^2 + 3n edges.
[[nodiscard]] Mesh bcc(std::uint64_t n, double size = 1);

/// One regular cell, inscribed in the cube [-scale, scale]^3: edges of length scale * sqrt(8).
/// Facet i lies opposite vertex i and has the marker i+1.
[[nodiscard]] Mesh regular(double scale = 1);

}  // namespace octetra::generator
