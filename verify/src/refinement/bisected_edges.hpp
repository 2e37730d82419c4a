#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// A vertex inserted between two others.
struct Split {
    EdgeVertices edge;
    VertexIndex midpoint;
};

/// The bisected edges of one cell, in descending order of length.
class BisectedEdges {
public:
    explicit BisectedEdges(const IndexVector<VertexIndex, Point>& points) : points_(&points) {}

    /// Adds an edge. Precondition: the cell has this edge, and it was not added before.
    void add(const Split& split) {
        // Insertion sort: the order is strict, and there are at most six.
        std::size_t k = count_++;
        for (; k > 0 && is_longer(split.edge, splits_[k - 1].edge); --k)
            splits_[k] = splits_[k - 1];
        splits_[k] = split;
    }

    [[nodiscard]] std::size_t size() const { return count_; }

    /// Calls visit(piece) for each piece of the cell after longest-edge bisection.
    void for_each_piece(const CellVertices& cell, auto&& visit) const {
        bisect(cell, {splits_.data(), count_}, visit);
    }

private:
    [[nodiscard]] bool is_longer(const EdgeVertices& e, const EdgeVertices& f) const {
        const auto& p = *points_;
        return longer({p[e[0]], p[e[1]]}, {p[f[0]], p[f[1]]});
    }

    static void bisect(const CellVertices& piece, std::span<const Split> longest_first,
                       auto& visit) {
        for (const auto& [edge, midpoint] : longest_first) {
            const auto position = [&](VertexIndex v) {
                return static_cast<std::size_t>(std::find(piece.begin(), piece.end(), v) -
                                                piece.begin());
            };
            const auto [low, high] = std::minmax({position(edge[0]), position(edge[1])});
            if (high == 4) continue;
            for (const std::size_t leaving : {high, low}) {  // the order of a refined mesh
                CellVertices half = piece;
                half[leaving] = midpoint;
                bisect(half, longest_first, visit);
            }
            return;
        }
        visit(piece);
    }

    const IndexVector<VertexIndex, Point>* points_;
    std::array<Split, 6> splits_;
    std::size_t count_ = 0;
};

}  // namespace octetra::verify
