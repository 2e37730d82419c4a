#pragma once

#include <octetra/reference/history.hpp>

#include "edges.hpp"

namespace octetra::reference {

/// Returns the edges that the marked cells mark, before closure.
[[nodiscard]] EdgeSet mark_edges(const Mesh& mesh, const EdgeTable& table, const CellMarks& marks,
                                 Scheme scheme);

/// Returns these edges and those added by closure, in ascending order.
[[nodiscard]] std::vector<EdgeVertices> edges_to_bisect(const Mesh& mesh, const CellMarks& marks,
                                                        Scheme scheme);

}  // namespace octetra::reference
