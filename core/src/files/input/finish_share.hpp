#pragma once

#include <vector>

#include <octetra/core/mesh_share.hpp>
#include <octetra/core/mesh_source.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra {

/// Returns whether a mesh with these markers has markers. `zeros_are_none`: if all are 0, it has
/// none.
[[nodiscard]] bool are_significant(const std::vector<Marker>& markers, bool zeros_are_none);

/// Collective. Sets the facts of a mesh, and the numbers of the first entities, after all processes
/// have read their shares; `counts` has the numbers of entities. Drops markers that are significant
/// on no process.
void finish_share(const MeshFacts& counts, bool zeros_are_none, const ProcessGroup& group,
                  MeshShare& share);

}  // namespace octetra
