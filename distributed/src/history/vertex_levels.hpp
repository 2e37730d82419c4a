#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// Maps a vertex to the level that made it, counted from 1; 0 for input vertices. Refers to the
/// mesh, which must not change during the lifetime of this object.
class VertexLevels {
public:
    explicit VertexLevels(const DistributedMesh& mesh)
        : begins_(mesh.level_begin),
          ends_(mesh.midpoint_to_edge),
          first_midpoint_(mesh.input_vertices.size()) {}

    [[nodiscard]] std::uint32_t of(VertexIndex v) const {
        const std::size_t last = begins_.size();
        if (last == 0 || v < begins_.front()) return 0;
        if (v >= begins_[last - 1]) return static_cast<std::uint32_t>(last);
        return static_cast<std::uint32_t>(std::ranges::upper_bound(begins_, v) - begins_.begin());
    }
    /// Returns the level of the newest vertex; for the vertices of a cell, the level that made the
    /// cell.
    template <std::size_t N>
    [[nodiscard]] std::uint32_t newest(const std::array<VertexIndex, N>& vertices) const {
        return of(newest_of(vertices));
    }
    /// Same as above, faster if the result is `guess`.
    template <std::size_t N>
    [[nodiscard]] std::uint32_t newest(const std::array<VertexIndex, N>& vertices,
                                       std::uint32_t guess) const {
        const VertexIndex v = newest_of(vertices);
        return begin(guess) <= v && v < end(guess) ? guess : of(v);
    }
    /// Returns the first vertex that this level made; if it made none, the first that it would have
    /// made.
    [[nodiscard]] VertexIndex begin(std::uint32_t level) const {
        return level == 0 ? VertexIndex{0} : begins_[level - 1];
    }
    /// Returns the first vertex that a later level made, or none().
    [[nodiscard]] VertexIndex end(std::uint32_t level) const {
        return level == begins_.size() ? VertexIndex::none() : begins_[level];
    }
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(begins_.size()); }

    /// Returns the ends of the edge that the midpoint halves, lower index first.
    [[nodiscard]] const EdgeVertices& ends(VertexIndex midpoint) const {
        return ends_[midpoint.value() - first_midpoint_];
    }

private:
    template <std::size_t N>
    static VertexIndex newest_of(const std::array<VertexIndex, N>& vertices) {
        return std::ranges::max(vertices);
    }

    std::span<const VertexIndex> begins_;
    std::span<const EdgeVertices> ends_;
    std::size_t first_midpoint_;
};

}  // namespace octetra::distributed
