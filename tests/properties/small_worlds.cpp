#include "properties/small_worlds.hpp"

#include <algorithm>

#include <octetra/core/edge_order.hpp>

#include "support/refinement.hpp"

namespace octetra::properties {
Mesh side_by_side(const std::vector<Mesh>& worlds, double distance) {
    Mesh all;
    double x = 0;
    for (const Mesh& world : worlds) {
        const std::size_t first = all.points.size();
        for (const Point& p : world.points) all.points.append({p.x + x, p.y, p.z});
        for (CellVertices cell : world.cells) {
            for (VertexIndex& v : cell) v = VertexIndex{first + v.value()};
            all.cells.append(cell);
        }
        x += distance;
    }
    return all;
}

Order order_of(const Mesh& mesh, CellIndex cell) {
    const Corners corners = test::corners_of(mesh, cell);
    const auto segment = [&](std::size_t e) {
        return Segment{corners[cell_edges[e][0]], corners[cell_edges[e][1]]};
    };
    Order order{0, 1, 2, 3, 4, 5};
    std::ranges::sort(order,
                      [&](std::size_t e, std::size_t f) { return longer(segment(e), segment(f)); });
    return order;
}

}  // namespace octetra::properties
