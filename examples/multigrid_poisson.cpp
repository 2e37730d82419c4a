// Solves the problem of reentrant_edge.hpp on meshes refined according to an error estimator, by
// conjugate gradients with one V-cycle of multigrid on the levels of the mesh, and again with
// algebraic multigrid. The smoother is PETSc's default, two steps of Chebyshev iteration, with
// Jacobi's method.
//     mpirun -n 2 ./multigrid_poisson longest-edge 100000
// The first argument is the closure, longest-edge or regular; the second is the number of unknowns
// at which the program ends. Options of PETSc for the two solvers have the prefixes levels_ and
// algebraic_, for example -algebraic_pc_type hypre -algebraic_pc_hypre_type boomeramg.
#include <petscksp.h>
#include <petscsys.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/petsc/interpolations.hpp>

#include "reentrant_edge.hpp"

namespace {

// Returns 1 for each vertex of a level whose value is unknown, else 0. The vertices of a level are
// the first ones of the mesh.
Vec unknowns_of(const od::Levels& levels, std::size_t level,
                const std::vector<std::uint8_t>& is_fixed) {
    const auto map = od::make_index_map(levels.processes(), levels.vertex_sharing(level),
                                        levels.points(level).size());
    Vec vector = nullptr;
    PetscScalar* values = nullptr;
    VecCreateMPI(PETSC_COMM_WORLD, static_cast<PetscInt>(map.owned_count), PETSC_DETERMINE,
                 &vector);
    VecGetArrayWrite(vector, &values);
    for (std::size_t k = 0; k < map.owned_count; ++k) {
        values[k] = is_fixed[map.entities[k].value()] == 0 ? 1 : 0;
    }
    VecRestoreArrayWrite(vector, &values);
    return vector;
}

void set_smoother(PC multigrid, PetscInt level, Mat matrix) {
    KSP smoother = nullptr;
    PC inner = nullptr;
    PCMGGetSmoother(multigrid, level, &smoother);
    KSPSetOperators(smoother, matrix, matrix);
    if (level == 0) return;  // a direct solver
    KSPSetType(smoother, KSPCHEBYSHEV);
    KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 2);
    KSPGetPC(smoother, &inner);
    PCSetType(inner, PCJACOBI);
}

// Sets the levels of the mesh. Vertices with given values take no part in the interpolation.
int set_levels(KSP solver, const od::AdaptiveMesh& mesh, Mat matrix,
               const std::vector<std::uint8_t>& is_fixed) {
    const od::Levels levels = mesh.levels();
    std::vector<Mat> interpolations = octetra::petsc::interpolations(levels);
    PC multigrid = nullptr;
    KSPGetPC(solver, &multigrid);
    PCSetType(multigrid, PCMG);
    PCMGSetLevels(multigrid, static_cast<PetscInt>(levels.count()), nullptr);
    PetscObjectReference(reinterpret_cast<PetscObject>(matrix));
    Vec fine = unknowns_of(levels, levels.count() - 1, is_fixed);
    for (std::size_t k = levels.count() - 1; k > 0; --k) {
        Mat& interpolation = interpolations[k - 1];
        Vec coarse = unknowns_of(levels, k - 1, is_fixed);
        MatDiagonalScale(interpolation, fine, coarse);
        PCMGSetInterpolation(multigrid, static_cast<PetscInt>(k), interpolation);
        set_smoother(multigrid, static_cast<PetscInt>(k), matrix);
        Mat coarse_matrix = nullptr;
        MatPtAP(matrix, interpolation, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &coarse_matrix);
        VecDestroy(&fine);
        VecDuplicate(coarse, &fine);
        VecSet(fine, 1);
        VecAXPY(fine, -1, coarse);
        MatDiagonalSet(coarse_matrix, fine, ADD_VALUES);  // rows of given values
        MatDestroy(&interpolation);
        MatDestroy(&matrix);
        VecDestroy(&fine);
        matrix = coarse_matrix;
        fine = coarse;
    }
    set_smoother(multigrid, 0, matrix);
    MatDestroy(&matrix);
    VecDestroy(&fine);
    return static_cast<int>(levels.count());
}

struct Solve {
    int levels = 0;
    int iterations = 0;
    double setup_seconds = 0;
    double solve_seconds = 0;
    double megabytes = 0;  // of all processes, with the matrices of coarser levels
};

double resident_megabytes() {
    PetscLogDouble bytes = 0;
    PetscMemoryGetCurrentUsage(&bytes);
    MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return bytes / 1e6;
}

// Solves by conjugate gradients. `prepare` sets the preconditioner, and returns its number of
// levels.
Solve solve(const System& system, const char* prefix, Vec solution, auto prepare) {
    Solve result;
    const double before = resident_megabytes();
    Stopwatch watch;
    KSP solver = nullptr;
    PetscInt iterations = 0;
    KSPCreate(PETSC_COMM_WORLD, &solver);
    KSPSetOptionsPrefix(solver, prefix);
    KSPSetOperators(solver, system.matrix, system.matrix);
    KSPSetType(solver, KSPCG);
    KSPSetTolerances(solver, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, 1000);
    result.levels = prepare(solver);
    KSPSetFromOptions(solver);
    KSPSetUp(solver);
    result.setup_seconds = watch.lap();
    KSPSolve(solver, system.right, solution);
    result.solve_seconds = watch.lap();
    result.megabytes = resident_megabytes() - before;
    KSPGetIterationNumber(solver, &iterations);
    result.iterations = static_cast<int>(iterations);
    KSPDestroy(&solver);
    return result;
}

int set_algebraic(KSP solver) {
    PC preconditioner = nullptr;
    KSPGetPC(solver, &preconditioner);
    PCSetType(preconditioner, PCGAMG);
    return 0;
}

void print(const od::AdaptiveMesh& mesh, const std::array<Solve, 2>& solves) {
    const std::uint64_t cells = mesh.processes().sum(mesh.cells().size());
    if (!mesh.processes().is_first()) return;
    std::printf("%10llu %10llu %6d", static_cast<unsigned long long>(cells),
                static_cast<unsigned long long>(mesh.vertex_count()), solves[0].levels);
    for (const Solve& one : solves) {
        std::printf(" %10d %8.2f %8.2f %8.0f", one.iterations, one.setup_seconds, one.solve_seconds,
                    one.megabytes);
    }
    std::printf("\n");
    std::fflush(stdout);
}

// Solves with both preconditioners, and returns the solution at each vertex of this process.
std::vector<double> solve_and_print(const od::AdaptiveMesh& mesh) {
    const Dofs dofs = number_dofs(mesh);
    const std::vector<std::uint8_t> is_fixed = on_sides(mesh);
    System system;
    assemble(mesh, dofs, system);
    set_boundary_values(mesh, dofs, is_fixed, system);
    Vec solution = nullptr;
    VecDuplicate(system.right, &solution);
    std::array<Solve, 2> solves;
    solves[0] = solve(system, "levels_", solution, [&](KSP solver) {
        return set_levels(solver, mesh, system.matrix, is_fixed);
    });
    const std::vector<double> u = at_vertices(mesh, dofs, solution);
    solves[1] = solve(system, "algebraic_", solution, set_algebraic);
    VecDestroy(&solution);
    print(mesh, solves);
    return u;
}

void run(octetra::Closure closure, std::uint64_t enough_unknowns) {
    od::AdaptiveMesh mesh = distributed_mesh();
    if (mesh.processes().is_first()) {
        std::printf("%28s %37s %37s\n%10s %10s %6s", "", "levels of the mesh",
                    "algebraic multigrid", "cells", "unknowns", "levels");
        for (int k = 0; k < 2; ++k) {
            std::printf(" %10s %8s %8s %8s", "iterations", "setup s", "solve s", "MB");
        }
        std::printf("\n");
    }
    while (true) {
        const std::vector<double> u = solve_and_print(mesh);
        if (mesh.vertex_count() >= enough_unknowns) return;
        const std::vector<double> eta2 = estimate(mesh, gradients_of(mesh, u));
        const auto marks = od::mark_bulk(mesh.processes(), eta2, 0.5);
        (void)mesh.refine_evenly(marks, {}, {.closure = closure});
    }
}

}  // namespace

int main(int argc, char** argv) {
    PetscInitialize(&argc, &argv, nullptr, nullptr);
    int status = 0;
    const std::string closure = argc > 1 ? argv[1] : "";
    const long long unknowns = argc > 2 ? std::atoll(argv[2]) : 0;
    if ((closure != "longest-edge" && closure != "regular") || unknowns <= 0) {
        PetscFPrintf(PETSC_COMM_WORLD, stderr,
                     "usage: multigrid_poisson longest-edge|regular UNKNOWNS\n");
        status = 2;
    } else {
        try {
            run(closure == "regular" ? octetra::Closure::regular : octetra::Closure::longest_edge,
                static_cast<std::uint64_t>(unknowns));
        } catch (const std::exception& error) {  // the same on all processes
            std::fprintf(stderr, "%s\n", error.what());
            status = 2;
        }
    }
    PetscFinalize();
    return status;
}
