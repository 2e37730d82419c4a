#pragma once

#include <cstdint>

#include <octetra/core/process_group.hpp>

#include "rivals/border.hpp"

namespace octetra::rivals {

/// Collective. Finds the entities that parts share by the global numbers of their vertices: a
/// rendezvous rank notifies the sharers of each edge and face at the boundary of a part. Adds the
/// rows around shared edges to the graph. Throws InputError on all ranks if a face has more than
/// two cells.
[[nodiscard]] Border first_border(const ProcessGroup& ranks, CellGraph& graph,
                                  const IndexVector<VertexIndex, std::uint64_t>& vertex_numbers);

}  // namespace octetra::rivals
