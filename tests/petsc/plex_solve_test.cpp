#include <gtest/gtest.h>
#include <petscds.h>
#include <petscfe.h>
#include <petscsnes.h>

#include <octetra/distributed/exchange.hpp>
#include <octetra/petsc/versions.hpp>

#include "petsc/plex_support.hpp"

/// Solves Laplace's equation on a plex with PETSc's finite elements: a linear function is
/// reproduced exactly.
namespace octetra::petsc {
namespace {

PetscErrorCode linear(PetscInt, PetscReal, const PetscReal x[], PetscInt, PetscScalar* u, void*) {
    *u = 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2];
    return 0;
}

// The weak form in PETSc's interface: the gradient, and its derivative with respect to the
// gradient.
void gradient(PetscInt dim, PetscInt, PetscInt, const PetscInt[], const PetscInt[],
              const PetscScalar[], const PetscScalar[], const PetscScalar u_x[], const PetscInt[],
              const PetscInt[], const PetscScalar[], const PetscScalar[], const PetscScalar[],
              PetscReal, const PetscReal[], PetscInt, const PetscScalar[], PetscScalar f[]) {
    for (PetscInt d = 0; d < dim; ++d) f[d] = u_x[d];
}
void identity(PetscInt dim, PetscInt, PetscInt, const PetscInt[], const PetscInt[],
              const PetscScalar[], const PetscScalar[], const PetscScalar[], const PetscInt[],
              const PetscInt[], const PetscScalar[], const PetscScalar[], const PetscScalar[],
              PetscReal, PetscReal, const PetscReal[], PetscInt, const PetscScalar[],
              PetscScalar g[]) {
    for (PetscInt d = 0; d < dim; ++d) g[d * dim + d] = 1;
}

/// Elements of this order, with the linear function on the boundary.
void set_problem(DM plex, PetscInt order) {
    DMLabel boundary = nullptr;
    must(DMGetLabel(plex, "boundary", &boundary));
    PetscFE element = nullptr;
    must(PetscFECreateLagrange(PETSC_COMM_WORLD, 3, 1, PETSC_TRUE, order, PETSC_DETERMINE,
                               &element));
    must(DMSetField(plex, 0, nullptr, reinterpret_cast<PetscObject>(element)));
    must(PetscFEDestroy(&element));
    must(DMCreateDS(plex));
    PetscDS problem = nullptr;
    must(DMGetDS(plex, &problem));
    must(PetscDSSetResidual(problem, 0, nullptr, &gradient));
    must(PetscDSSetJacobian(problem, 0, 0, nullptr, nullptr, nullptr, &identity));
    const PetscInt one = 1;
    must(DMAddBoundary(plex, DM_BC_ESSENTIAL, "boundary", boundary, 1, &one, 0, 0, nullptr,
                       reinterpret_cast<void (*)()>(&linear), nullptr, nullptr, nullptr));
}

/// The number of vertices of the whole mesh that are on no boundary face.
std::uint64_t count_inner_vertices(const distributed::AdaptiveMesh& mesh) {
    std::vector<std::uint8_t> is_outer(mesh.points().size(), 0);
    for (const auto& [cell, face] : mesh.boundary()) {
        for (const auto corner : cell_faces[face]) {
            is_outer[mesh.cells()[cell.value()][corner].value()] = 1;
        }
    }
    distributed::combine_everywhere(mesh.processes(), mesh.vertex_sharing(), is_outer.size(),
                                    is_outer, [](auto a, auto b) { return std::max(a, b); });
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < is_outer.size(); ++v) {
        if (is_outer[v] == 0 && mesh.vertex_sharing().is_owned(VertexIndex{v})) ++count;
    }
    return mesh.processes().sum(count);
}

class PlexElements : public testing::TestWithParam<PetscInt> {};
INSTANTIATE_TEST_SUITE_P(Orders, PlexElements, testing::Values(1, 2, 3));

TEST_P(PlexElements, SolveForALinearFunctionExactly) {
    const distributed::AdaptiveMesh mesh = adapted_mesh("random:3", GetParam() == 3 ? 1 : 2);
    const OwnedPlex plex(to_plex(mesh));
    set_problem(plex, GetParam());
    SNES solver = nullptr;
    Vec u = nullptr;
    must(SNESCreate(PETSC_COMM_WORLD, &solver));
    must(SNESSetDM(solver, plex));
    must(set_snes_local_fem(plex));
    KSP ksp = nullptr;
    PC preconditioner = nullptr;
    must(SNESGetKSP(solver, &ksp));
    must(KSPSetTolerances(ksp, 1e-13, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
    must(KSPSetType(ksp, KSPCG));
    must(KSPGetPC(ksp, &preconditioner));
    must(PCSetType(preconditioner, PCJACOBI));
    must(DMCreateGlobalVector(plex, &u));
    must(VecSet(u, 0));
    must(SNESSolve(solver, nullptr, u));

    PetscInt unknowns = 0;
    must(VecGetSize(u, &unknowns));
    if (GetParam() == 1) {
        EXPECT_EQ(static_cast<std::uint64_t>(unknowns), count_inner_vertices(mesh));
    }
    EXPECT_GT(unknowns, 10);
    PetscErrorCode (*exact[1])(PetscInt, PetscReal, const PetscReal[], PetscInt, PetscScalar*,
                               void*) = {&linear};
    PetscReal error = 1;
    must(DMComputeL2Diff(plex, 0, exact, nullptr, u, &error));
    EXPECT_LT(error, 1e-10);
    must(VecDestroy(&u));
    must(SNESDestroy(&solver));
}

}  // namespace
}  // namespace octetra::petsc
