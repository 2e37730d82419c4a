// A mesh created in parts by the processes of a solver, refined, and returned as arrays with global
// numbers. Here each process creates a slab of a bar of cubes, each divided into six cells.
//     mpirun -n 4 ./from_solver_parts
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/exchange.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;

namespace {

// Returns cube number k of the bar: its vertices are 4 k .. 4 k + 7, the last four shared with the
// next cube.
od::MeshPart slab(std::uint64_t k) {
    od::MeshPart part;
    for (std::uint64_t v = 0; v < 8; ++v) {
        part.vertex_numbers.push_back(4 * k + v);
        part.points.push_back({static_cast<double>(k + v / 4), static_cast<double>(v & 1U),
                               static_cast<double>(v >> 1U & 1U)});
    }
    std::array<std::uint64_t, 3> step{4, 1, 2};
    std::sort(step.begin(), step.end());
    do {
        std::array<std::uint64_t, 4> cell{4 * k, 4 * k + step[0], 4 * k + step[0] + step[1],
                                          4 * k + 7};
        const bool is_right_handed = (step[0] == 1 && step[1] == 2) ||
                                     (step[0] == 2 && step[1] == 4) ||
                                     (step[0] == 4 && step[1] == 1);
        // Axes are y, z, x by ascending steps, an even permutation of x, y, z.
        if (!is_right_handed) std::swap(cell[2], cell[3]);
        part.cells.push_back(cell);
        part.regions.push_back(static_cast<octetra::Marker>(k));
    } while (std::next_permutation(step.begin(), step.end()));
    return part;
}

void run() {
    const od::Communicator processes = od::communicator_of(MPI_COMM_WORLD);
    od::AdaptiveMesh mesh =
        od::AdaptiveMesh::from_parts(processes, slab(static_cast<std::uint64_t>(processes.rank())));
    (void)mesh.refine(std::vector<std::uint8_t>(mesh.cells().size(), 1));

    // The arrays for a solver: cells by global vertex numbers, and the owner of each vertex.
    std::vector<std::array<std::uint64_t, 4>> cells;
    for (const octetra::CellVertices& cell : mesh.cells()) {
        auto& global = cells.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            global[k] = static_cast<std::uint64_t>(mesh.vertex_numbers()[cell[k].value()]);
        }
    }
    // An assembly loop: the lumped mass of each vertex, summed over the processes that share it.
    std::vector<double> mass(mesh.points().size(), 0);
    for (const octetra::CellVertices& cell : mesh.cells()) {
        for (const octetra::VertexIndex v : cell) mass[v.value()] += 1.0 / (6 * 8 * 4);
    }
    od::combine_everywhere(processes, mesh.vertex_sharing(), mass.size(), std::span(mass),
                           std::plus<>());
    double own = 0;
    for (std::size_t v = 0; v < mass.size(); ++v) {
        if (mesh.vertex_sharing().is_owned(octetra::VertexIndex{v})) own += mass[v];
    }
    double total = 0;
    MPI_Allreduce(&own, &total, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const auto count = processes.sum(cells.size());
    if (processes.is_first()) {
        std::printf("%llu cells, %llu vertices, mass %g of %d\n",
                    static_cast<unsigned long long>(count),
                    static_cast<unsigned long long>(mesh.vertex_count()), total, processes.size());
    }
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int status = 0;
    try {
        run();
    } catch (const std::exception& error) {  // the same on all processes
        std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    MPI_Finalize();
    return status;
}
