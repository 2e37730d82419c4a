// An adaptive loop without a solver: the mesh follows a steep front, u = atan(60 (|x| - 0.7)),
// which is interpolated instead of computed by a solver.
//     mpirun -n 4 ./adaptive_loop cube.mesh 5 front.vtu
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/estimator_marks.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;
using octetra::Point;

namespace {

double front(const Point& p) { return std::atan(60 * (std::hypot(p.x, p.y, p.z) - 0.7)); }

std::vector<double> solve(const od::AdaptiveMesh& mesh) {
    std::vector<double> u;
    for (const Point& p : mesh.points()) u.push_back(front(p));
    return u;
}

// Returns, for each cell of this process, the square of the maximum error of u at the midpoints of
// its edges.
std::vector<double> estimate(const od::AdaptiveMesh& mesh, const std::vector<double>& u) {
    std::vector<double> eta2;
    for (const octetra::CellVertices& cell : mesh.cells()) {
        double worst = 0;
        for (const auto& [i, j] : octetra::cell_edges) {
            const std::size_t a = cell[i].value();
            const std::size_t b = cell[j].value();
            const double exact = front(octetra::midpoint(mesh.points()[a], mesh.points()[b]));
            worst = std::max(worst, std::abs(exact - (u[a] + u[b]) / 2));
        }
        eta2.push_back(worst * worst);
    }
    return eta2;
}

// Returns the number of vertices of the whole mesh at which the guess, transferred from the
// previous mesh, is close to u.
std::uint64_t count_near(const od::AdaptiveMesh& mesh, const std::vector<double>& guess,
                         const std::vector<double>& u) {
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
        const bool is_owned = mesh.vertex_sharing().is_owned(octetra::VertexIndex{v});
        if (is_owned && std::abs(guess[v] - u[v]) < 0.05) ++count;
    }
    return mesh.processes().sum(count);
}

void run(const char* input, int steps, const char* output) {
    const od::Communicator processes = od::communicator_of(MPI_COMM_WORLD);
    od::AdaptiveMesh mesh = od::AdaptiveMesh::read(processes, input);
    std::vector<double> u = solve(mesh);
    for (int step = 1; step <= steps; ++step) {
        const std::vector<double> eta2 = estimate(mesh, u);
        const std::vector<std::uint8_t> marks = od::mark_bulk(processes, eta2, 0.5);
        const od::Adaptation adaptation = mesh.refine(marks);

        const std::vector<double> guess = adaptation.transfer_vertices(std::move(u));
        u = solve(mesh);
        const auto cells = processes.sum(mesh.cells().size());
        const auto near = count_near(mesh, guess, u);
        if (processes.is_first()) {
            std::printf("step %d: %llu cells, %llu vertices, a good first guess at %llu\n", step,
                        static_cast<unsigned long long>(cells),
                        static_cast<unsigned long long>(mesh.vertex_count()),
                        static_cast<unsigned long long>(near));
        }
    }
    (void)mesh.write(output);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int status = argc == 4 ? 0 : 2;
    if (argc != 4 && rank == 0) std::fprintf(stderr, "usage: adaptive_loop INPUT STEPS OUTPUT\n");
    try {
        if (argc == 4) run(argv[1], std::atoi(argv[2]), argv[3]);
    } catch (const std::exception& error) {  // the same on all processes
        if (rank == 0) std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    MPI_Finalize();
    return status;
}
