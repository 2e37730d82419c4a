#pragma once

#include <cstdint>

#include <octetra/core/mesh.hpp>

/// Delaunay meshes of point clouds, made by TetGen (without it they throw InputError).
///
/// Laws: vertices are numbered from 0 as they were drawn; every cell is positively oriented,
/// exactly; the facets are the faces of the convex hull, with marker 1. The points are the same
/// bits on every platform; the cells are as TetGen's version orders them.
/// Draws are made by std::mt19937_64, and a number u in [0, 1) is (draw >> 11) * 2^-53.
namespace octetra::generator {

/// `points` points, uniformly random in the unit cube: for each, x, y and z are drawn in turn.
/// Takes 4 to 2^26 points. About 6.7 cells per vertex when there are many.
[[nodiscard]] Mesh random(std::uint64_t points, std::uint64_t seed);

/// Bad cells on purpose: the points of an n x n x n lattice in the unit cube, numbered x fastest,
/// each coordinate moved at random by at most a millionth of the spacing: (i + 1e-6 (2u - 1)) /
/// (n-1), with x, y and z drawn in turn. The eight corners of every lattice cube lie nearly on one
/// sphere and those of every square nearly in one plane, so nearly flat cells abound; none is
/// exactly flat. Takes n from 2 to 400.
[[nodiscard]] Mesh slivers(std::uint64_t n, std::uint64_t seed);

}  // namespace octetra::generator
