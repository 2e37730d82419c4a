#pragma once

#include <petscdmplex.h>
#include <petscsf.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/petsc/to_plex.hpp>

#include "distributed/marked_mesh.hpp"
#include "distributed/world.hpp"

/// Common parts of the tests of the PETSc adapter.
namespace octetra::petsc {

/// Ends the test if PETSc returns an error.
inline void must(PetscErrorCode code) { ASSERT_EQ(code, 0); }

/// A DM that the destructor destroys.
class OwnedPlex {
public:
    OwnedPlex() = default;
    explicit OwnedPlex(DM plex) : plex_(plex) {}
    ~OwnedPlex() { (void)DMDestroy(&plex_); }
    OwnedPlex(const OwnedPlex&) = delete;
    OwnedPlex& operator=(const OwnedPlex&) = delete;
    OwnedPlex(OwnedPlex&& other) noexcept : plex_(std::exchange(other.plex_, nullptr)) {}
    OwnedPlex& operator=(OwnedPlex&& other) noexcept {
        std::swap(plex_, other.plex_);
        return *this;
    }
    operator DM() const { return plex_; }
    DM* address() { return &plex_; }

private:
    DM plex_ = nullptr;
};

/// A lattice with regions, facets and edges, refined, coarsened and, on several processes,
/// migrated. No marker is -1, which PETSc returns for points without a label value.
inline distributed::AdaptiveMesh adapted_mesh(const std::string& partition, std::size_t n = 2) {
    using namespace distributed;
    Mesh input = test::marked_lattice(n, 1);
    for (auto* markers : {&static_cast<std::vector<Marker>&>(input.facet_markers),
                          &static_cast<std::vector<Marker>&>(input.edge_markers)}) {
        for (Marker& marker : *markers) marker = marker == -1 ? 7 : marker;
    }
    AdaptiveMesh mesh = AdaptiveMesh::distribute(
        test::world(), input,
        partition_cells(input, test::world().size(), parse_partition(partition)));
    (void)mesh.refine(Selection{.spheres = {{{0.5, 0.5, 0.5}, 1.2}}});
    (void)mesh.refine(Selection{.random = RandomShare{0.2, 5}});
    (void)mesh.coarsen(Selection{.boxes = {{{1, 1, 1}, {3, 3, 3}}}});
    (void)mesh.rebalance({.most_over_mean = 1.3});
    return mesh;
}

inline PetscReal sum_over_all(PetscReal value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD);
    return value;
}

/// For each point of this process, whether another process owns it.
inline std::vector<char> are_leaves(DM plex) {
    PetscInt begin = 0;
    PetscInt end = 0;
    EXPECT_EQ(DMPlexGetChart(plex, &begin, &end), 0);
    std::vector<char> is_leaf(static_cast<std::size_t>(end), 0);
    PetscSF sharers = nullptr;
    PetscInt count = 0;
    const PetscInt* leaves = nullptr;
    EXPECT_EQ(DMGetPointSF(plex, &sharers), 0);
    EXPECT_EQ(PetscSFGetGraph(sharers, nullptr, &count, &leaves, nullptr), 0);
    for (PetscInt k = 0; k < count; ++k) {
        is_leaf[static_cast<std::size_t>(leaves == nullptr ? k : leaves[k])] = 1;
    }
    return is_leaf;
}

/// The vertices of a point, in the order of its closure.
inline std::vector<PetscInt> vertices_of(DM plex, PetscInt point) {
    PetscInt begin = 0;
    PetscInt end = 0;
    EXPECT_EQ(DMPlexGetDepthStratum(plex, 0, &begin, &end), 0);
    PetscInt count = 0;
    PetscInt* closure = nullptr;
    EXPECT_EQ(DMPlexGetTransitiveClosure(plex, point, PETSC_TRUE, &count, &closure), 0);
    std::vector<PetscInt> vertices;
    for (PetscInt k = 0; k < count; ++k) {
        if (closure[2 * k] >= begin && closure[2 * k] < end) vertices.push_back(closure[2 * k]);
    }
    EXPECT_EQ(DMPlexRestoreTransitiveClosure(plex, point, PETSC_TRUE, &count, &closure), 0);
    return vertices;
}

/// All checks that PETSc offers for a plex.
inline void expect_valid(DM plex) {
    must(DMPlexCheckSymmetry(plex));
    must(DMPlexCheckSkeleton(plex, 0));
    must(DMPlexCheckFaces(plex, 0));
    must(DMPlexCheckGeometry(plex));
    must(DMPlexCheckPointSF(plex, nullptr, PETSC_FALSE));
    must(DMPlexCheckInterfaceCones(plex));
    must(DMPlexCheck(plex));
}

}  // namespace octetra::petsc
