#pragma once

#include <vector>

#include <octetra/core/cut_runs.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// The history of a part in canonical order: for each level how it cut the cells that there were
/// before, all of them in their canonical order. Nothing of it is kept while a mesh is refined: a
/// vertex tells which level made it, and which edge it halves. Takes time in proportion to the
/// part, and to the levels for each cell that was cut. Not collective.
[[nodiscard]] std::vector<CutRuns> steps_of(const DistributedMesh& mesh);

/// The same part as the input was: its cells, tagged facets and edges with their ancestors, and the
/// vertices with what they have. It has no interfaces, so it cannot be refined.
[[nodiscard]] DistributedMesh input_of(const DistributedMesh& mesh);

}  // namespace octetra::distributed
