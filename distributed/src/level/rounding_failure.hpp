#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/distributed_mesh.hpp>

namespace octetra::distributed {

/// A cell that cannot be bisected because its midpoints are rounded: the first one in canonical
/// order, encoded so that a smaller code denotes an earlier cell.
class RoundingFailure {
public:
    /// Records that a descendant of this cell of the input is flat (sign 0) or inverted. Among the
    /// bad children of one root, only the first in canonical order may be recorded.
    void note(std::uint64_t root, int sign) {
        code_ = std::min(code_, 2 * root + (sign < 0 ? 1U : 0U));
    }
    [[nodiscard]] bool found() const { return code_ != none; }

    /// Collective. Throws on all processes if any has found a failure.
    void agree(const DistributedMesh& mesh, int level) const;

private:
    static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t code_ = none;
};

/// The exact orientation of a child; 0 if a coordinate is not finite.
[[nodiscard]] inline int sign_of(const CellVertices& child,
                                 const IndexVector<VertexIndex, Point>& p) {
    if (!std::ranges::all_of(child, [&](VertexIndex v) { return is_finite(p[v]); })) return 0;
    return orientation(p[child[0]], p[child[1]], p[child[2]], p[child[3]]);
}

}  // namespace octetra::distributed
