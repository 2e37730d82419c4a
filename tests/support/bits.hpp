#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::test {

/// The coordinates as bit patterns, equal only if all bits are (-0.0 differs from 0.0).
inline std::vector<std::uint64_t> bits(const Mesh& mesh) {
    std::vector<std::uint64_t> result;
    for (const Point& p : mesh.points) {
        for (const double c : {p.x, p.y, p.z}) result.push_back(std::bit_cast<std::uint64_t>(c));
    }
    return result;
}

}  // namespace octetra::test
