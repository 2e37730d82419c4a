#pragma once

#include <cstdint>

#include <octetra/core/process_group.hpp>

#include "rivals/border.hpp"

namespace octetra::rivals {

/// Collective. What the ranks' parts have in common, by the vertices' numbers in the whole mesh: of
/// each edge and face at the boundary of a part a rank that its numbers determine hears which
/// others have it. The graph comes to know the rows around shared edges. Throws InputError on all
/// ranks where parts have more than two cells at a face.
[[nodiscard]] Border first_border(const ProcessGroup& ranks, CellGraph& graph,
                                  const IndexVector<VertexIndex, std::uint64_t>& vertex_numbers);

}  // namespace octetra::rivals
