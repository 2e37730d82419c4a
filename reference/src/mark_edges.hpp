#pragma once

#include <octetra/core/selection.hpp>

#include "edges.hpp"

namespace octetra::reference {

/// The edges that the marked cells mark, before closure. `cell_to_parent` leads to the cells of
/// the input.
[[nodiscard]] EdgeSet mark_edges(const Mesh& mesh, const EdgeTable& table,
                                 const Selection& selection, Scheme scheme,
                                 const IndexVector<CellIndex, CellIndex>& cell_to_parent);

}  // namespace octetra::reference
