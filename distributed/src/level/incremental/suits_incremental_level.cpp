#include "level/incremental/suits_incremental_level.hpp"

#include <vector>

#include "level/incremental/adjacency.hpp"

namespace octetra::distributed {

bool suits_incremental_level(const DistributedMesh& mesh, const MarkedCells& marked,
                             const Tuning& tuning, bool is_last) {
    if (marked.all || !Adjacency::can_hold(mesh)) return false;
    if (is_last && mesh.adjacency == nullptr) return false;
    const auto most = tuning.incremental_below * static_cast<double>(mesh.points.size());
    std::vector<bool> is_met(mesh.points.size(), false);
    std::size_t met = 0;
    for (const CellIndex c : marked.cells) {
        for (const VertexIndex v : mesh.cells[c]) {
            if (is_met[v.value()]) continue;
            is_met[v.value()] = true;
            if (static_cast<double>(++met) >= most) return false;
        }
    }
    return most > 0;
}

}  // namespace octetra::distributed
