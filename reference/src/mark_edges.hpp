#pragma once

#include <octetra/reference/history.hpp>

#include "edges.hpp"

namespace octetra::reference {

/// The edges that the marked cells mark, before closure.
[[nodiscard]] EdgeSet mark_edges(const Mesh& mesh, const EdgeTable& table, const CellMarks& marks,
                                 Scheme scheme);

/// These and what closure adds, ascending.
[[nodiscard]] std::vector<EdgeVertices> edges_to_bisect(const Mesh& mesh, const CellMarks& marks,
                                                        Scheme scheme);

}  // namespace octetra::reference
