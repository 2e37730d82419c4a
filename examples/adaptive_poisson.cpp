// Solves the problem of reentrant_edge.hpp (PETSc: CG with algebraic multigrid) on meshes refined
// according to an error estimator, or uniformly.
//     mpirun -n 4 ./adaptive_poisson adaptive 7 step      writes step.0.vtu, step.1.vtu ...
#include <petscksp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>

#include "reentrant_edge.hpp"

namespace {

std::vector<double> solve(const od::AdaptiveMesh& mesh) {
    const Dofs dofs = number_dofs(mesh);
    System system;
    assemble(mesh, dofs, system);
    set_boundary_values(mesh, dofs, on_sides(mesh), system);

    KSP solver = nullptr;
    PC preconditioner = nullptr;
    KSPCreate(PETSC_COMM_WORLD, &solver);
    KSPSetOperators(solver, system.matrix, system.matrix);
    KSPSetType(solver, KSPCG);
    KSPGetPC(solver, &preconditioner);
    PCSetType(preconditioner, PCGAMG);
    KSPSetTolerances(solver, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 1000);
    KSPSetFromOptions(solver);
    KSPSolve(solver, system.right, system.unknown);
    KSPDestroy(&solver);
    return at_vertices(mesh, dofs, system.unknown);
}

double squared_error(const od::AdaptiveMesh& mesh, const std::vector<Vector>& gradients) {
    const double far = (5 + 3 * std::sqrt(5.0)) / 20;  // four points, exact for quadratic functions
    const double near = (5 - std::sqrt(5.0)) / 20;
    double sum = 0;
    for (std::size_t c = 0; c < gradients.size(); ++c) {
        const auto p = corners_of(mesh, c);
        const double volume = CellGeometry(p).volume;
        for (std::size_t i = 0; i < 4; ++i) {
            Point q;
            for (std::size_t k = 0; k < 4; ++k) {
                const double weight = k == i ? far : near;
                q.x += weight * p[k].x, q.y += weight * p[k].y, q.z += weight * p[k].z;
            }
            const Vector exact = gradient(q);
            for (std::size_t x = 0; x < 3; ++x) {
                sum += volume / 4 * (exact[x] - gradients[c][x]) * (exact[x] - gradients[c][x]);
            }
        }
    }
    return sum;
}

// ---- the loop -----------------------------------------------------------------------------------

double sum_of(double own) {
    double sum = 0;
    MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return sum;
}

void run(bool adaptive, int steps, const std::string& output) {
    auto mesh = distributed_mesh();
    const od::Communicator processes = mesh.processes();
    if (processes.is_first()) {
        std::printf("%9s %9s %10s %10s %7s %9s %8s %8s %8s %8s\n", "cells", "dofs", "H1 error",
                    "estimator", "rate", "most/mean", "solve", "estimate", "mark", "refine");
    }
    double last_error = 0;
    double last_dofs = 0;
    Stopwatch watch;
    for (int step = 0; step <= steps; ++step) {
        std::array<double, 4> seconds{};
        watch.lap();
        const std::vector<double> u = solve(mesh);
        seconds[0] = watch.lap();
        const std::vector<Vector> gradients = gradients_of(mesh, u);
        const std::vector<double> eta2 = estimate(mesh, gradients);
        seconds[1] = watch.lap();

        const double error = std::sqrt(sum_of(squared_error(mesh, gradients)));
        double own = 0;
        for (const double e : eta2) own += e;
        const double eta = std::sqrt(sum_of(own));
        const auto dofs = static_cast<double>(mesh.vertex_count());
        const auto cells = processes.sum(mesh.cells().size());
        const double most = static_cast<double>(processes.max(mesh.cells().size())) *
                            processes.size() / static_cast<double>(cells);
        if (!output.empty()) {
            const od::Field field{"u", octetra::FieldOn::vertices, 1, u};
            (void)mesh.write(output + "." + std::to_string(step) + ".vtu", std::array{field});
        }

        watch.lap();
        if (step < steps) {
            const std::vector<std::uint8_t> marks =
                adaptive ? od::mark_bulk(processes, eta2, 0.5)
                         : std::vector<std::uint8_t>(mesh.cells().size(), 1);
            seconds[2] = watch.lap();
            (void)mesh.refine(marks);
            seconds[3] = watch.lap();
        }
        if (processes.is_first()) {
            const double rate = std::log(error / last_error) / std::log(dofs / last_dofs);
            std::printf("%9llu %9.0f %10.6f %10.6f %7.3f %9.2f %8.3f %8.3f %8.3f %8.3f\n",
                        static_cast<unsigned long long>(cells), dofs, error, eta,
                        step == 0 ? 0 : rate, most, seconds[0], seconds[1], seconds[2], seconds[3]);
        }
        last_error = error;
        last_dofs = dofs;
    }
}

}  // namespace

int main(int argc, char** argv) {
    PetscInitialize(&argc, &argv, nullptr, nullptr);
    int status = 0;
    try {
        const std::string kind = argc > 1 ? argv[1] : "adaptive";
        run(kind != "uniform", argc > 2 ? std::atoi(argv[2]) : 5, argc > 3 ? argv[3] : "");
    } catch (const std::exception& error) {  // the same on all processes
        std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    PetscFinalize();
    return status;
}
