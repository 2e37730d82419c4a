#pragma once

#include <vector>

#include <octetra/core/mesh.hpp>

#include "script/read_script.hpp"

namespace octetra::cli {

/// About how many cells each cell of the mesh becomes by the refinements of a script, as far as
/// its criteria tell without lists of cells; what is coarsened again is left out. Empty where all
/// become equally many. For distributed::partition_cells(). Not collective.
[[nodiscard]] std::vector<float> predicted_by_steps(const Mesh& mesh, const Script& script);

}  // namespace octetra::cli
