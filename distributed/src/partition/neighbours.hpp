#pragma once

#include <array>
#include <cstdint>

#include <octetra/core/mesh.hpp>

#include "partition/inner_faces.hpp"

namespace octetra::distributed {

/// A cell on the other side of a face.
struct Neighbour {
    static constexpr std::uint32_t none = (1U << 30U) - 1;
    std::uint32_t cell : 30 = none;
    std::uint32_t paths : 2 = 0;  ///< number of the two cells with their longest edge in the face
};

/// The neighbours of each cell, in unspecified order, before unused entries. 16 bytes per cell.
using Neighbours = IndexVector<CellIndex, std::array<Neighbour, 4>>;

/// Returns the neighbours of all cells. paths(face, a, b) must return how many of the two cells
/// have their longest edge in the face. There must be fewer than 2^30 - 1 cells.
[[nodiscard]] Neighbours neighbours_of_cells(const Mesh& mesh, auto&& paths) {
    Neighbours neighbours(mesh.cells.size());
    const auto append = [&](CellIndex to, CellIndex cell, unsigned through) {
        for (Neighbour& neighbour : neighbours[to]) {
            if (neighbour.cell != Neighbour::none) continue;
            neighbour.cell = cell.value() & Neighbour::none;
            neighbour.paths = through & 3U;
            return;
        }
    };
    for_each_inner_face(mesh, [&](const FacetVertices& face, CellIndex a, CellIndex b) {
        const unsigned through = paths(face, a, b);
        append(a, b, through);
        append(b, a, through);
    });
    return neighbours;
}

}  // namespace octetra::distributed
