#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/partition.hpp>

#include <gtest/gtest.h>

#include "distributed/marked_mesh.hpp"
#include "distributed/reference_steps.hpp"
#include "distributed/shared_folder.hpp"
#include "distributed/world.hpp"
#include "support/meshes.hpp"
#include "support/refinement.hpp"

/// Common parts of the tests of migration.
namespace octetra::distributed {

inline Selection some(double share, std::uint64_t seed) {
    return {.random = RandomShare{share, seed}};
}

/// A mesh with all kinds of data, and with a vertex of no cell.
inline Mesh input_of(std::uint64_t seed, std::size_t cubes = 4) {
    Mesh mesh = test::marked_lattice(cubes, seed);
    mesh.points.push_back({9, 9, 9});
    mesh.point_markers.push_back(7);
    mesh.point_attributes.insert(mesh.point_attributes.end(), {1.5, 2.5});
    return test::featured(std::move(mesh), seed);
}

inline AdaptiveMesh distributed_mesh(Mesh mesh, const std::string& partition) {
    std::vector<int> parts =
        partition_cells(mesh, test::world().size(), parse_partition(partition));
    return AdaptiveMesh::distribute(test::world(), std::move(mesh), parts);
}

/// Two copies of one mesh, one of which migrates, and the reference.
struct MovingAndResting {
    AdaptiveMesh moving;
    AdaptiveMesh resting;
    test::ReferenceSteps reference;

    explicit MovingAndResting(std::uint64_t seed, std::size_t cubes = 4)
        : moving(distributed_mesh(input_of(seed, cubes), "random:" + std::to_string(seed))),
          resting(distributed_mesh(input_of(seed, cubes), "block")),
          reference(input_of(seed, cubes)) {}

    /// Collective. Compares both copies with the reference after they have made the step.
    void expect_step(const Selection& selection, bool refines) {
        if (refines) {
            reference.refine(selection);
        } else {
            reference.coarsen(selection);
        }
        const Mesh found = moving.collect();
        EXPECT_TRUE(found == reference.mesh() || !test::world().is_first());
        EXPECT_EQ(moving.vertex_count(), resting.vertex_count());
    }

    /// Collective.
    void expect_same_checkpoints() const {
        const test::SharedFolder folder;
        moving.save(folder / "moved.octetra");
        resting.save(folder / "rested.octetra");
        if (!test::world().is_first()) return;
        EXPECT_TRUE(test::content_of(folder / "moved.octetra") ==
                    test::content_of(folder / "rested.octetra"));
    }
};

inline double most_over_mean(const AdaptiveMesh& mesh) {
    const std::uint64_t count = mesh.cells().size();
    return static_cast<double>(test::world().max(count)) * test::world().size() /
           static_cast<double>(test::world().sum(count));
}

}  // namespace octetra::distributed
