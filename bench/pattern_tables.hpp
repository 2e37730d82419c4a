#pragma once

#include <vector>

#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra::bench {

/// Makes the engine's pattern tables, which a process makes once and whose cost is not part of
/// repeated refinement. Not collective.
inline void make_pattern_tables() {
    const Mesh cube = test::kuhn(1, 1, 1);
    const std::vector<int> parts(cube.cells.size(), 0);
    auto mesh = distributed::distribute({}, cube, parts);
    (void)distributed::refine(mesh, {.all = true}, {});
}

}  // namespace octetra::bench
