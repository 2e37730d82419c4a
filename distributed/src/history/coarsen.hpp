#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octetra/distributed/distributed_mesh.hpp>

#include "comm/local_failure.hpp"
#include "history/cuts.hpp"

namespace octetra::distributed {

/// What is left of a part when cells go back by a generation.
struct Coarser {
    std::vector<CutRuns> steps;
    /// For each vertex that stays, the number that it had. All vertices ascend still.
    std::vector<VertexIndex> vertices_before;
    /// For each cell of before, the cell that it is, or is a piece of, and how often that was
    /// halved for it.
    std::vector<CellIndex> cell_after;
    std::vector<std::uint8_t> halvings;
};

/// Collective. The history of a mesh in canonical order without the vertices that no one needs when
/// the cells that `may_go` marks (a byte for each) go back by one generation. Those stay that (a)
/// the input has, or a present cell that is not marked, or a cell that some step cut; and (b) with
/// the midpoint of an edge that a step bisected, for every face of the mesh before that step which
/// has the edge, the midpoint of the face's longest edge. Edges whose midpoints go are struck from
/// their steps; a step of which nothing is left is dropped. Nothing depends on the partition.
///
/// Takes time in proportion to the part, for each step. Where a process has failed or fails, the
/// result is not to be used on any.
[[nodiscard]] Coarser coarsen(const DistributedMesh& mesh, std::span<const CutRuns> steps,
                              std::span<const std::uint8_t> may_go, LocalFailure& failure);

}  // namespace octetra::distributed
