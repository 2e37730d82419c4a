#pragma once

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"
#include "setup/homes.hpp"
#include "setup/vertex_set.hpp"

namespace octetra::distributed {

/// The corners of the cells of a stretch.
class StretchCorners {
public:
    /// Collective. Fetches the points that this process has not read itself.
    StretchCorners(const Communicator& processes, const Homes& homes, const MeshStretch& stretch,
                   LocalFailure& failure)
        : cells_(&stretch.lists.cells) {
        std::vector<std::uint32_t> numbers;
        failure.attempt([&] {
            vertices_ = VertexSet(*cells_);
            numbers = vertices_.numbers();
        });
        const auto requests = request(processes, homes, numbers, failure);
        const std::vector<Point>& home = stretch.lists.points;
        points_ = fetch(processes, requests, home, stretch.first_vertex, failure);
    }

    /// Of the stretch's cell number i.
    [[nodiscard]] Corners of(std::size_t i) const {
        const auto& [a, b, c, d] = (*cells_)[CellIndex{i}];
        return {point(a), point(b), point(c), point(d)};
    }

private:
    [[nodiscard]] const Point& point(VertexIndex v) const {
        return points_[vertices_.place_of(v).value()];
    }

    const IndexVector<CellIndex, CellVertices>* cells_;
    VertexSet vertices_;
    std::vector<Point> points_;
};

}  // namespace octetra::distributed
