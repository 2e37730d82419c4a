#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "shapes/integers.hpp"
#include "shapes/patterns.hpp"
#include "shapes/root_shape.hpp"

namespace octetra::verify::shapes {

template <class Int>
[[nodiscard]] std::uint64_t low_bits(const Int& number) {
    if constexpr (std::is_same_v<Int, Int128>) {
        return static_cast<std::uint64_t>(number) ^ static_cast<std::uint64_t>(number >> 64);
    } else {
        const Int size = number < 0 ? Int(-number) : number;
        return static_cast<std::uint64_t>(Int(size & Int(~std::uint64_t{0}))) +
               (number < 0 ? 1U : 0U);
    }
}

/// A set of arrays of integers in the order of insertion, in flat arrays that are reused.
template <class Int, std::size_t N>
class ShapeSet {
public:
    using Shape = std::array<Int, N>;

    void clear() {
        std::ranges::fill(slots_, 0U);
        shapes_.clear();
        hashes_.clear();
    }

    void insert(const Shape& shape) {
        if (2 * (shapes_.size() + 1) > slots_.size()) grow();
        const std::uint64_t hash = hash_of(shape);
        std::size_t slot = slot_of_hash(hash);
        for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
            const std::size_t found = slots_[slot] - 1;
            if (hashes_[found] == hash && shapes_[found] == shape) return;
        }
        shapes_.push_back(shape);
        hashes_.push_back(hash);
        slots_[slot] = static_cast<std::uint32_t>(shapes_.size());
    }

    [[nodiscard]] std::size_t size() const { return shapes_.size(); }
    [[nodiscard]] const Shape& operator[](std::size_t k) const { return shapes_[k]; }

private:
    static std::uint64_t hash_of(const Shape& shape) {
        std::uint64_t hash = 0;
        for (const Int& x : shape) {
            hash = (hash ^ low_bits(x)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 29U;
        }
        return hash;
    }

    [[nodiscard]] std::size_t slot_of_hash(std::uint64_t hash) const {
        return static_cast<std::size_t>(hash) & (slots_.size() - 1);
    }

    void grow() {
        constexpr std::size_t least = 256;
        slots_.assign(std::max(least, 2 * slots_.size()), 0);
        for (std::size_t k = 0; k < hashes_.size(); ++k) {
            std::size_t slot = slot_of_hash(hashes_[k]);
            while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = static_cast<std::uint32_t>(k + 1);
        }
    }

    std::vector<Shape> shapes_;
    std::vector<std::uint64_t> hashes_;
    std::vector<std::uint32_t> slots_;  ///< one more than an index of shapes_; 0: free
};

/// Renumberings of the edges of a tetrahedron by the 24 orders of its corners.
inline constexpr std::array<std::array<std::uint8_t, 6>, 24> edge_orders = [] {
    std::array<std::array<std::uint8_t, 6>, 24> orders{};
    std::array<std::uint8_t, 4> corners{0, 1, 2, 3};
    for (auto& order : orders) {
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [i, j] = cell_edges[e];
            order[e] = static_cast<std::uint8_t>(edge_between(corners[i], corners[j]));
        }
        std::ranges::next_permutation(corners);
    }
    return orders;
}();

/// Returns the squared lengths in the order of corners for which they are lexicographically least:
/// equal for two tetrahedra if and only if they are congruent, perhaps as mirror images.
template <class Int>
[[nodiscard]] std::array<Int, 6> up_to_congruence(const std::array<Int, 6>& lengths) {
    const auto* best = &edge_orders.front();
    for (const auto& order : edge_orders) {
        for (std::size_t e = 0; e < 6; ++e) {
            const Int& here = lengths[order[e]];
            const Int& there = lengths[(*best)[e]];
            if (here == there) continue;
            if (here < there) best = &order;
            break;
        }
    }
    std::array<Int, 6> least;
    for (std::size_t e = 0; e < 6; ++e) least[e] = lengths[(*best)[e]];
    return least;
}

/// Returns the squared lengths of the edges of a cell with the corners 0, a, b, c.
template <class Int>
[[nodiscard]] std::array<Int, 6> squared_lengths(const Vectors<Int>& v) {
    std::array<Int, 6> lengths;
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = cell_edges[e];
        Int sum = 0;
        for (std::size_t x = 0; x < 3; ++x) {
            const Int to = v[3 * (j - 1U) + x];
            const Int d = i == 0 ? to : Int(to - v[3 * (i - 1U) + x]);
            sum += d * d;
        }
        lengths[e] = sum;
    }
    return lengths;
}

/// Returns the vectors of a piece of a cell, in units in which the cell has twice its size.
template <class Int>
[[nodiscard]] Vectors<Int> vectors_of_piece(const Piece& piece, const Vectors<Int>& v) {
    const auto coordinate = [&](std::size_t corner, std::size_t x) {
        return corner == 0 ? Int(0) : v[3 * (corner - 1) + x];
    };
    std::array<std::array<Int, 3>, 4> points;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t p = piece.points[k];
        const auto [a, b] =
            p < 4 ? std::array{std::uint8_t(p), std::uint8_t(p)} : cell_edges[p - 4];
        for (std::size_t x = 0; x < 3; ++x) points[k][x] = coordinate(a, x) + coordinate(b, x);
    }
    std::ranges::sort(points);
    Vectors<Int> vectors;
    for (std::size_t k = 0; k < 9; ++k) vectors[k] = points[1 + k / 3][k % 3] - points[0][k % 3];
    return vectors;
}

}  // namespace octetra::verify::shapes
