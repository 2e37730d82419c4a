#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

namespace octetra::verify {

/// A hash table of the vertices of a mesh by coordinates. Keeps a pointer to the points.
class PointLookup {
public:
    explicit PointLookup(const IndexVector<VertexIndex, Point>& points) : points_(&points) {
        std::size_t size = 16;
        while (size < 2 * points.size()) size *= 2;
        slots_.assign(size, VertexIndex::none());
        for (VertexIndex v{0}; v < points.end_index(); ++v) {
            std::size_t i = first_slot(points[v]);
            while (!slots_[i].is_none()) i = next(i);
            slots_[i] = v;
        }
    }

    /// Returns the first vertex, by number, with these coordinates for which wanted(v) holds, or
    /// none().
    [[nodiscard]] VertexIndex find(const Point& p, auto&& wanted) const {
        for (std::size_t i = first_slot(p); !slots_[i].is_none(); i = next(i)) {
            if ((*points_)[slots_[i]] == p && wanted(slots_[i])) return slots_[i];
        }
        return VertexIndex::none();
    }

private:
    [[nodiscard]] std::size_t first_slot(const Point& p) const {
        std::uint64_t h = 0;
        for (const double c : {p.x, p.y, p.z}) {
            // Adding +0.0 converts -0.0, which compares equal, to +0.0.
            h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15U;
            h ^= h >> 29U;
        }
        return h & (slots_.size() - 1);
    }
    [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) & (slots_.size() - 1); }

    const IndexVector<VertexIndex, Point>* points_;
    std::vector<VertexIndex> slots_;
};

}  // namespace octetra::verify
