#pragma once

#include <array>

#include <octetra/core/mesh.hpp>

namespace octetra::rivals {

/// For each cell, the cells behind its faces, indexed by the opposite vertex; none() at the
/// boundary. Throws InputError if a face has three cells.
[[nodiscard]] IndexVector<CellIndex, std::array<CellIndex, 4>> face_neighbours(const Mesh& mesh);

}  // namespace octetra::rivals
