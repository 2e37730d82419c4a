// Poisson's equation, -div grad u = 1 with u = 0 on the boundary, with PETSc's finite elements on a
// DMPlex: in each step the mesh is converted to a plex, PETSc solves the equation on it, and the
// cells with the largest variation of the solution are refined.
//     mpirun -n 4 ./petsc_plex cube.mesh 3
#include <petscdmplex.h>
#include <petscds.h>
#include <petscfe.h>
#include <petscsnes.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <vector>

#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/mpi.hpp>
#include <octetra/petsc/to_plex.hpp>
#include <octetra/petsc/versions.hpp>

namespace od = octetra::distributed;
namespace op = octetra::petsc;

namespace {

void check(PetscErrorCode code) {
    if (code != 0) throw std::runtime_error("PETSc failed");
}

// ---- the equation, as PETSc asks for it: f0 of the test function, f1 of its gradient
// ------------------

void minus_one(PetscInt, PetscInt, PetscInt, const PetscInt[], const PetscInt[],
               const PetscScalar[], const PetscScalar[], const PetscScalar[], const PetscInt[],
               const PetscInt[], const PetscScalar[], const PetscScalar[], const PetscScalar[],
               PetscReal, const PetscReal[], PetscInt, const PetscScalar[], PetscScalar f0[]) {
    f0[0] = -1;
}
void gradient(PetscInt dim, PetscInt, PetscInt, const PetscInt[], const PetscInt[],
              const PetscScalar[], const PetscScalar[], const PetscScalar u_x[], const PetscInt[],
              const PetscInt[], const PetscScalar[], const PetscScalar[], const PetscScalar[],
              PetscReal, const PetscReal[], PetscInt, const PetscScalar[], PetscScalar f1[]) {
    for (PetscInt d = 0; d < dim; ++d) f1[d] = u_x[d];
}
void identity(PetscInt dim, PetscInt, PetscInt, const PetscInt[], const PetscInt[],
              const PetscScalar[], const PetscScalar[], const PetscScalar[], const PetscInt[],
              const PetscInt[], const PetscScalar[], const PetscScalar[], const PetscScalar[],
              PetscReal, PetscReal, const PetscReal[], PetscInt, const PetscScalar[],
              PetscScalar g3[]) {
    for (PetscInt d = 0; d < dim; ++d) g3[d * dim + d] = 1;
}
PetscErrorCode zero(PetscInt, PetscReal, const PetscReal[], PetscInt, PetscScalar* u, void*) {
    *u = 0;
    return 0;
}

// Defines the problem with linear elements; to_plex() has labelled the boundary.
void set_problem(DM plex) {
    DMLabel boundary = nullptr;
    check(DMGetLabel(plex, "boundary", &boundary));
    PetscFE element = nullptr;
    check(PetscFECreateLagrange(PETSC_COMM_WORLD, 3, 1, PETSC_TRUE, 1, PETSC_DETERMINE, &element));
    check(DMSetField(plex, 0, nullptr, reinterpret_cast<PetscObject>(element)));
    check(PetscFEDestroy(&element));
    check(DMCreateDS(plex));
    PetscDS problem = nullptr;
    check(DMGetDS(plex, &problem));
    check(PetscDSSetResidual(problem, 0, minus_one, gradient));
    check(PetscDSSetJacobian(problem, 0, 0, nullptr, nullptr, nullptr, identity));
    const PetscInt one = 1;
    check(DMAddBoundary(plex, DM_BC_ESSENTIAL, "wall", boundary, 1, &one, 0, 0, nullptr,
                        reinterpret_cast<void (*)()>(zero), nullptr, nullptr, nullptr));
    check(op::set_snes_local_fem(plex));
}

// Returns the solution at each vertex of this process, by the mesh's local numbers.
std::vector<double> at_vertices(DM plex, Vec u, const od::AdaptiveMesh& mesh) {
    Vec local = nullptr;
    PetscSection section = nullptr;
    check(DMGetLocalVector(plex, &local));
    check(VecSet(local, 0));  // including boundary values, which are not unknowns
    check(DMGlobalToLocal(plex, u, INSERT_VALUES, local));
    check(DMGetLocalSection(plex, &section));
    const op::PlexPoints points = op::points_of(plex);
    const PetscScalar* numbers = nullptr;
    check(VecGetArrayRead(local, &numbers));
    std::vector<double> values;
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
        PetscInt place = 0;
        check(PetscSectionGetOffset(section, points.of(octetra::VertexIndex{v}), &place));
        values.push_back(numbers[place]);
    }
    check(VecRestoreArrayRead(local, &numbers));
    check(DMRestoreLocalVector(plex, &local));
    return values;
}

struct Solution {
    std::vector<double> at_vertices;
    PetscInt unknowns = 0;
};

Solution solve(const od::AdaptiveMesh& mesh) {
    DM plex = op::to_plex(mesh);
    set_problem(plex);
    SNES solver = nullptr;
    KSP ksp = nullptr;
    Vec u = nullptr;
    check(SNESCreate(PETSC_COMM_WORLD, &solver));
    check(SNESSetDM(solver, plex));
    check(SNESSetType(solver, SNESKSPONLY));  // the equation is linear
    check(SNESGetKSP(solver, &ksp));
    check(KSPSetType(ksp, KSPCG));
    check(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    check(SNESSetFromOptions(solver));  // -pc_type gamg, -ksp_monitor ...
    check(DMCreateGlobalVector(plex, &u));
    check(SNESSolve(solver, nullptr, u));
    Solution solution{at_vertices(plex, u, mesh), 0};
    check(VecGetSize(u, &solution.unknowns));
    check(VecDestroy(&u));
    check(SNESDestroy(&solver));
    check(DMDestroy(&plex));
    return solution;
}

// The volume of a cell and the integral of u over it.
struct CellIntegral {
    double volume = 0;
    double of_u = 0;
    double spread = 0;  // range of the values at its vertices
};

std::vector<CellIntegral> integrals(const od::AdaptiveMesh& mesh, const std::vector<double>& u) {
    std::vector<CellIntegral> all;
    for (const octetra::CellVertices& cell : mesh.cells()) {
        octetra::Corners corners;
        double sum = 0;
        double low = u[cell[0].value()];
        double high = low;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh.points()[cell[k].value()];
            const double value = u[cell[k].value()];
            sum += value;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        const double volume = octetra::volume(corners);
        all.push_back({volume, volume * sum / 4, high - low});
    }
    return all;
}

void run(const char* input, int steps) {
    const od::Communicator processes = od::communicator_of(PETSC_COMM_WORLD);
    od::AdaptiveMesh mesh = od::AdaptiveMesh::read(processes, input);
    // Function spaces of refined meshes contain the previous ones, so the integral increases.
    check(PetscPrintf(PETSC_COMM_WORLD, "    cells  unknowns  integral of u\n"));
    for (int step = 0;; ++step) {
        const Solution solution = solve(mesh);
        double integral = 0;
        std::vector<double> eta2;
        for (const CellIntegral& cell : integrals(mesh, solution.at_vertices)) {
            integral += cell.of_u;
            eta2.push_back(cell.volume * cell.spread * cell.spread);
        }
        MPI_Allreduce(MPI_IN_PLACE, &integral, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
        const auto cells = processes.sum(mesh.cells().size());
        check(PetscPrintf(PETSC_COMM_WORLD, "%9llu %9lld %14.8f\n",
                          static_cast<unsigned long long>(cells),
                          static_cast<long long>(solution.unknowns), integral));
        if (step == steps) break;
        (void)mesh.refine(od::mark_maximum(processes, eta2, 0.2));
        (void)mesh.rebalance();
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
    int status = argc >= 3 ? 0 : 2;
    if (argc < 3) (void)PetscPrintf(PETSC_COMM_WORLD, "usage: petsc_plex INPUT STEPS\n");
    try {
        if (argc >= 3) run(argv[1], std::atoi(argv[2]));
    } catch (const std::exception& error) {  // the same on all processes
        (void)PetscPrintf(PETSC_COMM_WORLD, "%s\n", error.what());
        status = 2;
    }
    return PetscFinalize() == 0 ? status : 1;
}
