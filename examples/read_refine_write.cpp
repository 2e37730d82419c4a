// A minimal program: reads a mesh, refines it twice around the origin, writes it.
//     mpirun -n 4 ./read_refine_write bracket.mesh refined.mesh
#include <mpi.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;

namespace {

// Returns a byte for each cell of this process: whether its centroid is near the centre.
std::vector<std::uint8_t> marks_near(const od::AdaptiveMesh& mesh, const octetra::Point& centre,
                                     double radius) {
    std::vector<std::uint8_t> marks;
    for (const octetra::CellVertices& cell : mesh.cells()) {
        octetra::Point c;
        for (const octetra::VertexIndex v : cell) {
            const octetra::Point& p = mesh.points()[v.value()];
            c.x += p.x / 4, c.y += p.y / 4, c.z += p.z / 4;
        }
        marks.push_back(std::hypot(c.x - centre.x, c.y - centre.y, c.z - centre.z) < radius);
    }
    return marks;
}

void run(const char* input, const char* output) {
    const od::Communicator processes = od::communicator_of(MPI_COMM_WORLD);
    od::AdaptiveMesh mesh = od::AdaptiveMesh::read(processes, input);
    for (const double radius : {0.5, 0.25}) {
        const od::Adaptation step = mesh.refine(marks_near(mesh, {0, 0, 0}, radius));
        const auto cells = processes.sum(mesh.cells().size());
        if (processes.is_first()) {
            std::printf("%llu cells, %llu vertices%s\n", static_cast<unsigned long long>(cells),
                        static_cast<unsigned long long>(mesh.vertex_count()),
                        step.changed ? "" : " (nothing was marked)");
        }
    }
    const std::string lost = mesh.write(output);
    if (processes.is_first() && !lost.empty()) std::printf("%s\n", lost.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int status = argc == 3 ? 0 : 2;
    if (argc != 3 && rank == 0) std::fprintf(stderr, "usage: read_refine_write INPUT OUTPUT\n");
    try {
        if (argc == 3) run(argv[1], argv[2]);
    } catch (const std::exception& error) {  // the same on all processes
        if (rank == 0) std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    MPI_Finalize();
    return status;
}
