#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/partition.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"

/// What tests of cells that move have in common.
namespace octetra::distributed {

inline Selection some(double share, std::uint64_t seed) {
    return {.random = RandomShare{share, seed}};
}

/// A mesh with everything, and with a vertex of no cell.
inline Mesh input_of(std::uint64_t seed) {
    Mesh mesh = test::marked_lattice(4, seed);
    mesh.points.push_back({9, 9, 9});
    mesh.point_markers.push_back(7);
    mesh.point_attributes.insert(mesh.point_attributes.end(), {1.5, 2.5});
    return mesh;
}

inline AdaptiveMesh shared_out(Mesh mesh, const std::string& partition) {
    std::vector<int> parts =
        partition_cells(mesh, test::world().size(), parse_partition(partition));
    return AdaptiveMesh::distribute(test::world(), std::move(mesh), parts);
}

inline double most_over_mean(const AdaptiveMesh& mesh) {
    const std::uint64_t count = mesh.cells().size();
    return static_cast<double>(test::world().max(count)) * test::world().size() /
           static_cast<double>(test::world().sum(count));
}

}  // namespace octetra::distributed
