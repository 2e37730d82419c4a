// The same steps as steps.py in C++, for comparison with Python.
//     bench_python_steps MESH uniform|medium|small STEPS
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/mpi.hpp>

namespace {

namespace od = octetra::distributed;

/// Marks all cells, a thousand adjacent ones, or one of this rank's; in later steps the descendants
/// with the same numbers.
std::vector<std::uint8_t> marks_of(const od::AdaptiveMesh& mesh, std::string_view kind) {
    std::vector<std::uint8_t> marks(mesh.cells().size(), kind == "uniform" ? 1 : 0);
    std::fill_n(marks.begin() + 7, kind == "medium" ? 1000 : 1, std::uint8_t{1});
    return marks;
}

}  // namespace

int main(int argc, char** argv) {
    // mpi4py starts MPI in this mode, in which its calls take longer.
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
    if (argc != 4) return 2;
    od::AdaptiveMesh mesh = od::AdaptiveMesh::read(od::communicator_of(MPI_COMM_WORLD), argv[1]);
    for (int step = 0; step < std::atoi(argv[3]); ++step) {
        const auto marks = marks_of(mesh, argv[2]);
        const auto marked = std::ranges::count(marks, 1);  // also caches the marks, as in Python
        MPI_Barrier(MPI_COMM_WORLD);
        const auto begin = std::chrono::steady_clock::now();
        (void)mesh.refine(marks);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        if (mesh.processes().is_first()) {
            std::printf("%.9f %td\n", seconds.count(), static_cast<std::ptrdiff_t>(marked));
        }
    }
    MPI_Finalize();
}
