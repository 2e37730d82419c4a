#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::test {

struct FaceCensus {
    std::size_t faces = 0;
    std::size_t boundary_faces = 0;
    std::size_t faults = 0;  ///< faces of more than two cells, or of two with equal orientation
};

/// Counts the faces of the cells. A conforming mesh has no faults, and its boundary faces tile the
/// boundary; a hanging vertex adds faces to their count.
inline FaceCensus count_faces(const Mesh& mesh) {
    struct Face {
        std::array<VertexIndex, 3> sorted;
        bool even = false;  // whether the outward order is an even permutation of the sorted one
        auto operator<=>(const Face&) const = default;
    };
    // Outward-facing vertex orders of the four faces of a positively oriented cell.
    constexpr std::array<std::array<std::size_t, 3>, 4> outward{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::vector<Face> faces;
    faces.reserve(4 * mesh.cells.size());
    for (const CellVertices& cell : mesh.cells) {
        for (const auto& [i, j, k] : outward) {
            const std::array<VertexIndex, 3> v{cell[i], cell[j], cell[k]};
            Face face{v, false};
            std::ranges::sort(face.sorted);
            const auto lowest = static_cast<std::size_t>(std::ranges::min_element(v) - v.begin());
            face.even = v[(lowest + 1) % 3] == face.sorted[1];
            faces.push_back(face);
        }
    }
    std::ranges::sort(faces);
    FaceCensus census;
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        while (end < faces.size() && faces[end].sorted == faces[begin].sorted) ++end;
        ++census.faces;
        const std::size_t cells = end - begin;
        if (cells == 1) ++census.boundary_faces;
        if (cells > 2 || (cells == 2 && faces[begin].even == faces[begin + 1].even)) {
            ++census.faults;
        }
    }
    return census;
}

}  // namespace octetra::test
