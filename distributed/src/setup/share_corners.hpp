#pragma once

#include <span>

#include <octetra/core/mesh_share.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

#include "setup/owners.hpp"
#include "setup/vertex_set.hpp"

namespace octetra::distributed {

/// Provides the corners of the cells of a process's share. During the lifetime of this object,
/// these cells refer to their vertices by index in the sorted list of their vertices, because
/// looking up the index of a global number is slow.
class ShareCorners {
public:
    /// Collective, within a transaction. Fetches the points that other processes have read.
    ShareCorners(const Communicator& processes, const OwnerMap& owners, MeshShare& share)
        : cells_(&share.lists.cells) {
        VertexSet vertices(*cells_);
        numbers_ = vertices.numbers();
        const auto requests = request(processes, owners, numbers_);
        const std::vector<Point>& owned = share.lists.points;
        points_ = fetch(processes, requests, owned, share.first_vertex);
        for (CellVertices& cell : *cells_) {
            for (VertexIndex& v : cell) v = vertices.local_of(v);
        }
    }

    /// The cells, with vertex indices into points().
    [[nodiscard]] std::span<const CellVertices> cells() const {
        return {cells_->data(), cells_->size()};
    }
    [[nodiscard]] std::span<const Point> points() const { return points_; }

    /// Returns the corners of cell i of the share.
    [[nodiscard]] Corners of(std::size_t i) const {
        const auto& [a, b, c, d] = (*cells_)[CellIndex{i}];
        return {points_[a.value()], points_[b.value()], points_[c.value()], points_[d.value()]};
    }

    /// Prefetches the points of cell i, if there is one. In an unordered mesh they are scattered,
    /// and access to them would be bound by memory latency.
    void prefetch(std::size_t i) const {
        if (i >= cells_->size()) return;
        for (const VertexIndex v : (*cells_)[CellIndex{i}]) __builtin_prefetch(&points_[v.value()]);
    }

    /// Returns the global vertex numbers of cell i.
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
    std::vector<std::uint32_t> numbers_;  // global numbers, by vertex index
    std::vector<Point> points_;
};

}  // namespace octetra::distributed
