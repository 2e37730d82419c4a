#pragma once

#include "edges.hpp"

namespace octetra::reference {

/// The smallest set that contains `marked` and, with any edge of a face of a cell, that face's
/// longest edge. The edges so added lie along the longest-edge propagation paths (LEPP) of the
/// marked ones. The order in which faces are visited does not matter: the rule only adds, so the
/// least fixed point is unique.
[[nodiscard]] EdgeSet close(EdgeSet marked, const Mesh& mesh, const EdgeTable& table);

}  // namespace octetra::reference
