#pragma once

#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Collective, within a transaction. Returns the greatest sizes h that are at most `sizes`, one for
/// each cell of this process, with
///
///     h(a) <= h(b) + (gradation - 1) |centroid(a) - centroid(b)|
///
/// for all cells a and b of the whole mesh that share a face. They are the least sums along the
/// paths from cell to cell, each added up from its beginning, and therefore the same for any
/// partition. No size may be NaN.
[[nodiscard]] std::vector<double> graded_sizes(const DistributedMesh& mesh,
                                               std::vector<double> sizes, double gradation);

}  // namespace octetra::distributed
