#include <array>
#include <cstddef>

#include <octetra/generator/lattices.hpp>

#include "box_sides.hpp"
#include "parameters.hpp"

namespace octetra::generator {
namespace {

/// The cells of a brick, around its diagonal. Bit 0 of a corner's number is set at the high end of
/// x, bit 1 of y, bit 2 of z.
constexpr std::array<std::array<std::size_t, 4>, 6> brick_cells{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

void check(std::uint64_t nx, std::uint64_t ny, std::uint64_t nz, const Size& size) {
    check_count(nx, 1, VertexIndex::limit - 2, "the number of bricks along x");
    check_count(ny, 1, VertexIndex::limit - 2, "the number of bricks along y");
    check_count(nz, 1, VertexIndex::limit - 2, "the number of bricks along z");
    check_length(size.x, "the size along x");
    check_length(size.y, "the size along y");
    check_length(size.z, "the size along z");
    const auto x = static_cast<double>(nx);
    const auto y = static_cast<double>(ny);
    const auto z = static_cast<double>(nz);
    check_numberable((x + 1) * (y + 1) * (z + 1), "vertices");
    check_numberable(6 * x * y * z, "cells");
    check_numberable(4 * (x * y + y * z + z * x), "facets");
}

double coordinate(std::uint64_t i, double size, std::uint64_t n) {
    return (static_cast<double>(i) * size) / static_cast<double>(n);
}

}  // namespace

Mesh kuhn(std::uint64_t nx, std::uint64_t ny, std::uint64_t nz, const Size& size) {
    check(nx, ny, nz, size);
    Mesh mesh;
    mesh.points.reserve((nx + 1) * (ny + 1) * (nz + 1));
    for (std::uint64_t k = 0; k <= nz; ++k) {
        for (std::uint64_t j = 0; j <= ny; ++j) {
            for (std::uint64_t i = 0; i <= nx; ++i) {
                mesh.points.push_back({coordinate(i, size.x, nx), coordinate(j, size.y, ny),
                                       coordinate(k, size.z, nz)});
            }
        }
    }

    const std::size_t step_y = nx + 1;
    const std::size_t step_z = step_y * (ny + 1);
    const auto add_brick = [&](std::size_t low) {
        const auto corner = [&](std::size_t bits) {
            return VertexIndex{low + (bits & 1U) + (bits >> 1U & 1U) * step_y +
                               (bits >> 2U) * step_z};
        };
        for (const auto& [a, b, c, d] : brick_cells) {
            mesh.cells.push_back({corner(a), corner(b), corner(c), corner(d)});
        }
    };
    mesh.cells.reserve(6 * nx * ny * nz);
    for (std::size_t k = 0; k < nz; ++k) {
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t i = 0; i < nx; ++i) add_brick(k * step_z + j * step_y + i);
        }
    }
    list_box_sides(mesh, mesh.points.back());
    return mesh;
}

}  // namespace octetra::generator
