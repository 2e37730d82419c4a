#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"
#include "setup/stretch_corners.hpp"

namespace octetra::distributed {

/// Cells that have come to their part, in the order of their numbers in the whole mesh.
struct CellsOfPart {
    IndexVector<CellIndex, CellVertices> cells;  ///< vertices by numbers in the whole mesh
    std::vector<std::uint64_t> numbers;
    std::vector<Marker> regions;  ///< or empty
};

/// Collective. The cells of all stretches go where `parts` says, one of each cell of this
/// process's stretch, whose vertices `corners` knows. Those that stay do so in the memory that they
/// were read into: of `stretch` no cells and regions are left, and of `corners` no cells.
[[nodiscard]] CellsOfPart send_cells(const Communicator& processes, MeshStretch& stretch,
                                     const StretchCorners& corners, const std::vector<int>& parts,
                                     LocalFailure& failure);

}  // namespace octetra::distributed
