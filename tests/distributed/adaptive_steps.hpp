#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "distributed/world.hpp"

/// Common parts of the tests of AdaptiveMesh.
namespace octetra::distributed {

inline AdaptiveMesh distributed_mesh(const Mesh& mesh, const Partition& partition) {
    return AdaptiveMesh::distribute(test::world(), mesh,
                                    partition_cells(mesh, test::world().size(), partition));
}

inline Corners corners_of(const AdaptiveMesh& mesh, std::size_t cell) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.points()[mesh.cells()[cell][k].value()];
    return corners;
}

inline std::vector<std::uint8_t> marks_of(const AdaptiveMesh& mesh, const Selection& selection) {
    std::vector<std::uint8_t> bytes(mesh.cells().size());
    for (std::size_t c = 0; c < bytes.size(); ++c) {
        bytes[c] = marks(selection, corners_of(mesh, c), 0, GlobalCell{0}) ? 1 : 0;
    }
    return bytes;
}

/// Steps that change few, many, few cells: incremental levels, full sweeps, and transitions between
/// them.
inline const std::vector<Selection> steps{
    {.spheres = {{{0.5, 0.5, 0.5}, 0.45}}}, {.spheres = {{{0.5, 0.5, 0.5}, 0.35}}},
    {.random = RandomShare{0.3, 5}},        {.spheres = {{{2.5, 2.5, 2.5}, 0.45}}},
    {.spheres = {{{2.5, 2.5, 2.5}, 0.35}}}, {.all = true},
};

/// Parametrised by the initial partition.
class AdaptiveMeshIn : public testing::TestWithParam<Partition> {};

}  // namespace octetra::distributed
