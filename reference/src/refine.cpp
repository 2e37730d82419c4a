#include <octetra/reference/history.hpp>

#include "bisect.hpp"
#include "mark_edges.hpp"

namespace octetra::reference {

Refinement refine(const Mesh& mesh, const Selection& selection, Scheme scheme, int levels,
                  std::size_t max_cells) {
    Refinement result = unrefined(mesh);
    for (int level = 1; level <= levels; ++level) {
        const auto edges = edges_to_bisect(result.mesh, marked_cells(result, selection), scheme);
        result = bisect_mesh(result, edges, level, max_cells);
    }
    return result;
}

}  // namespace octetra::reference
