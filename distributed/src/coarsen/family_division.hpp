#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "coarsen/coarser_list.hpp"
#include "level/rounding_failure.hpp"

namespace octetra::distributed {

/// Divides parents by fewer midpoints than before, and finds for each level the first bad child of
/// each root, as RoundingFailure requires. `root` is the position of a root among this process's
/// roots.
class FamilyDivision {
public:
    FamilyDivision(const DistributedMesh& mesh, std::size_t level_count)
        : mesh_(&mesh), failures_(level_count), last_root_(level_count, no_root) {}

    [[nodiscard]] Pieces<4> operator()(std::uint32_t level, std::size_t root,
                                       const CellVertices& cell, const KeptMidpoints<4>& midpoints);
    [[nodiscard]] Pieces<3> operator()(std::uint32_t level, std::size_t root,
                                       const FacetVertices& facet,
                                       const KeptMidpoints<3>& midpoints) const;
    [[nodiscard]] Pieces<2> operator()(std::uint32_t level, std::size_t root,
                                       const EdgeVertices& edge,
                                       const KeptMidpoints<2>& midpoint) const;

    [[nodiscard]] std::vector<RoundingFailure> failures() && { return std::move(failures_); }

private:
    static constexpr std::size_t no_root = std::numeric_limits<std::size_t>::max();

    void check(std::uint32_t level, std::size_t root, const CellVertices& cell,
               const Pieces<4>& pieces);

    const DistributedMesh* mesh_;
    std::vector<RoundingFailure> failures_;
    std::vector<std::size_t> last_root_;  ///< of each level, the last root with a bad child
};

}  // namespace octetra::distributed
