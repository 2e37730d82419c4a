#include <array>
#include <cstddef>

#include <octetra/generator/lattices.hpp>

#include "box_sides.hpp"
#include "parameters.hpp"

namespace octetra::generator {
namespace {

using Triple = std::array<std::size_t, 3>;

class Builder {
public:
    Builder(std::size_t n, double size) : n_(n), size_(size) {}

    Mesh build() {
        mesh_.points.reserve((n_ + 1) * (n_ + 1) * (n_ + 1) + n_ * n_ * n_ + 6 * n_ * n_);
        mesh_.cells.reserve(12 * n_ * n_ * (n_ + 1));
        add_lattice(n_ + 1, 0);
        first_centre_ = mesh_.points.size();
        add_lattice(n_, 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t layer = 0; layer <= n_; ++layer) add_layer(axis, layer);
        }
        const double high = coordinate(2 * n_);
        list_box_sides(mesh_, {high, high, high});
        return std::move(mesh_);
    }

private:
    /// Returns the coordinate of a plane or point at a distance of `halves` half cubes from the
    /// origin.
    [[nodiscard]] double coordinate(std::size_t halves) const {
        return (static_cast<double>(halves) * size_) / static_cast<double>(2 * n_);
    }

    VertexIndex add_point(const Triple& halves) {
        return mesh_.points.append(
            {coordinate(halves[0]), coordinate(halves[1]), coordinate(halves[2])});
    }

    void add_lattice(std::size_t count, std::size_t first_halves) {
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t j = 0; j < count; ++j) {
                for (std::size_t i = 0; i < count; ++i) {
                    add_point({2 * i + first_halves, 2 * j + first_halves, 2 * k + first_halves});
                }
            }
        }
    }

    [[nodiscard]] VertexIndex corner(const Triple& at) const {
        return VertexIndex{(at[2] * (n_ + 1) + at[1]) * (n_ + 1) + at[0]};
    }

    [[nodiscard]] VertexIndex centre(const Triple& cube) const {
        return VertexIndex{first_centre_ + (cube[2] * n_ + cube[1]) * n_ + cube[0]};
    }

    /// Adds the cells around the squares of one plane of the lattice.
    void add_layer(std::size_t axis, std::size_t layer) {
        for (std::size_t v = 0; v < n_; ++v) {
            for (std::size_t u = 0; u < n_; ++u) {
                Triple low{};
                low[axis] = layer;
                low[(axis + 1) % 3] = u;
                low[(axis + 2) % 3] = v;
                add_square(axis, low);
            }
        }
    }

    /// Adds the four cells around the segment through the square with the given low corner.
    void add_square(std::size_t axis, const Triple& low) {
        const std::size_t layer = low[axis];
        Triple cube_behind = low;
        cube_behind[axis] = layer - 1;
        const VertexIndex from = layer > 0 ? centre(cube_behind) : add_square_centre(axis, low);
        const VertexIndex to = layer < n_ ? centre(low) : add_square_centre(axis, low);

        constexpr std::array<std::array<std::size_t, 2>, 4> ring{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        const auto on_ring = [&](std::size_t position) {
            Triple at = low;
            at[(axis + 1) % 3] += ring[position % 4][0];
            at[(axis + 2) % 3] += ring[position % 4][1];
            return corner(at);
        };
        for (std::size_t r = 0; r < 4; ++r) {
            mesh_.cells.push_back({from, to, on_ring(r), on_ring(r + 1)});
        }
    }

    VertexIndex add_square_centre(std::size_t axis, const Triple& low) {
        Triple halves{2 * low[0] + 1, 2 * low[1] + 1, 2 * low[2] + 1};
        halves[axis] = 2 * low[axis];
        return add_point(halves);
    }

    std::size_t n_;
    double size_;
    std::size_t first_centre_ = 0;
    Mesh mesh_;
};

}  // namespace

Mesh bcc(std::uint64_t n, double size) {
    check_count(n, 1, VertexIndex::limit - 2, "the number of cubes along each axis");
    check_length(size, "the size");
    const auto count = static_cast<double>(n);
    check_numberable(12 * count * count * (count + 1), "cells");  // more than vertices or facets
    return Builder(n, size).build();
}

}  // namespace octetra::generator
