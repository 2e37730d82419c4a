#pragma once

#include <span>

#include <octetra/core/mesh_stretch.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"
#include "setup/homes.hpp"
#include "setup/vertex_set.hpp"

namespace octetra::distributed {

/// The corners of the cells of a stretch. While there is one, these cells have their vertices by
/// place among all that they have, as looking a place up takes time.
class StretchCorners {
public:
    /// Collective. Fetches the points that this process has not read itself.
    StretchCorners(const Communicator& processes, const Homes& homes, MeshStretch& stretch,
                   LocalFailure& failure)
        : cells_(&stretch.lists.cells) {
        VertexSet vertices;
        failure.attempt([&] {
            vertices = VertexSet(*cells_);
            numbers_ = vertices.numbers();
        });
        const auto requests = request(processes, homes, numbers_, failure);
        const std::vector<Point>& home = stretch.lists.points;
        points_ = fetch(processes, requests, home, stretch.first_vertex, failure);
        failure.attempt([&] {
            for (CellVertices& cell : *cells_) {
                for (VertexIndex& v : cell) v = vertices.place_of(v);
            }
        });
    }

    /// The cells with their vertices by place, and the points.
    [[nodiscard]] std::span<const CellVertices> cells() const {
        return {cells_->data(), cells_->size()};
    }
    [[nodiscard]] std::span<const Point> points() const { return points_; }

    /// Of the stretch's cell number i.
    [[nodiscard]] Corners of(std::size_t i) const {
        const auto& [a, b, c, d] = (*cells_)[CellIndex{i}];
        return {points_[a.value()], points_[b.value()], points_[c.value()], points_[d.value()]};
    }

    /// Brings the points of cell number i, if there is one, near the processor: in a mesh in no
    /// order they are far from each other, and would be waited for.
    void ask_for(std::size_t i) const {
        if (i >= cells_->size()) return;
        for (const VertexIndex v : (*cells_)[CellIndex{i}]) __builtin_prefetch(&points_[v.value()]);
    }

    /// The numbers of its vertices in the whole mesh.
    [[nodiscard]] CellVertices numbers_of(std::size_t i) const {
        CellVertices numbers;
        for (std::size_t k = 0; k < 4; ++k) {
            numbers[k] = VertexIndex{numbers_[(*cells_)[CellIndex{i}][k].value()]};
        }
        return numbers;
    }

    void forget_points() { std::vector<Point>().swap(points_); }

private:
    IndexVector<CellIndex, CellVertices>* cells_;
    std::vector<std::uint32_t> numbers_;  // of the vertices, by place
    std::vector<Point> points_;
};

}  // namespace octetra::distributed
