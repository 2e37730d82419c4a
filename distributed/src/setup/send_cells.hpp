#pragma once

#include <cstdint>
#include <vector>

#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/communicator.hpp>

#include "setup/share_corners.hpp"

namespace octetra::distributed {

/// The cells of a part, in the order of their global numbers.
struct CellsOfPart {
    IndexVector<CellIndex, CellVertices> cells;  ///< with global vertex numbers
    std::vector<std::uint64_t> numbers;
    std::vector<Marker> regions;  ///< may be empty
};

/// Collective, within a transaction. Sends each cell of this process's share to the rank that
/// `parts` states; `corners` provides their vertices. Cells that stay are kept in the memory that
/// they were read into: the cells and regions of `share` and the cells of `corners` must not be
/// used afterwards.
[[nodiscard]] CellsOfPart send_cells(const Communicator& processes, MeshShare& share,
                                     const ShareCorners& corners, const std::vector<int>& parts);

}  // namespace octetra::distributed
