#pragma once

#include <vector>

#include <octetra/core/cut_runs.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Returns the history of a part in canonical order: for each level, the patterns of all cells that
/// existed before it, in their canonical order. The history is not stored during refinement; it is
/// derived from the vertices, whose levels and parent edges are known. Takes time proportional to
/// the size of the part plus the number of levels for each cut cell. Not collective.
[[nodiscard]] std::vector<CutRuns> steps_of(const DistributedMesh& mesh);

/// Returns the part as it was in the input: cells, tagged facets and edges with their ancestors,
/// and vertices with attributes and markers. It has no interfaces and cannot be refined.
[[nodiscard]] DistributedMesh input_of(const DistributedMesh& mesh);

}  // namespace octetra::distributed
