// A front that moves through a mesh: a sphere whose centre moves along the bottom of the unit cube.
// In every cycle the mesh is coarsened behind the front, refined ahead of it, and rebalanced, and
// the front deposits heat at its position. The heat of a cell is divided among its pieces, and
// summed when pieces are merged, so the total heat equals the heat deposited.
//     mpirun -n 4 ./moving_front cube.mesh 50 front     writes front.vtkhdf, with all meshes, and
//     front.mesh
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <octetra/core/files/series.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/mpi.hpp>

namespace od = octetra::distributed;
using octetra::Point;

namespace {

constexpr double radius = 0.2;
constexpr double thickness = 0.01;  // thickness of the front
constexpr double finest = 0.01;     // maximum width of cells in the front

struct Front {
    double x = 0;  // x coordinate of the sphere's centre

    double distance(const Point& p) const {
        const double dx = p.x - x;
        const double dy = p.y - 0.5;
        return std::abs(std::sqrt(dx * dx + dy * dy + p.z * p.z) - radius);
    }
};

// The seconds of a cycle on this process.
struct Seconds {
    double coarsen = 0;
    double refine = 0;
    double rebalance = 0;
    double transfer = 0;
    double write = 0;
};

// Returns the result of work(), and adds its duration to `seconds`.
auto timed(double& seconds, auto&& work) {
    struct Clock {
        double* sum;
        double start = MPI_Wtime();
        ~Clock() { *sum += MPI_Wtime() - start; }
    };
    const Clock clock{&seconds};
    return work();
}

class HeatedMesh {
public:
    explicit HeatedMesh(od::AdaptiveMesh mesh)
        : mesh_(std::move(mesh)), heat_(mesh_.cells().size(), 0.0) {}

    const od::AdaptiveMesh& mesh() const { return mesh_; }

    void follow(const Front& front, Seconds& seconds) {
        // The criteria differ by a margin, so that coarsened cells are not refined again
        // immediately.
        const auto is_behind = [](double distance, double width) {
            return distance > thickness + 4 * width;
        };
        const auto is_ahead = [](double distance, double width) {
            return distance < thickness + width && width > finest;
        };
        bool changes = true;
        while (changes) {
            const auto marks = marked(front, is_behind);
            changes = take(timed(seconds.coarsen, [&] { return mesh_.coarsen(marks); }), seconds);
        }
        changes = true;
        while (changes) {
            const auto marks = marked(front, is_ahead);
            changes = take(timed(seconds.refine, [&] { return mesh_.refine(marks); }), seconds);
        }
        const od::Migration move = timed(seconds.rebalance, [&] { return mesh_.rebalance(); });
        heat_ = timed(seconds.transfer, [&] { return move.cells(std::move(heat_)); });
    }

    void heat_up(const Front& front) {
        for (std::size_t c = 0; c < heat_.size(); ++c) {
            const auto corners = corners_of(c);
            const double depth = front.distance(octetra::centroid(corners)) / thickness;
            const double heat = octetra::volume(corners) * std::exp(-depth * depth);
            heat_[c] += heat;
            left_ += heat;
        }
    }

    void append_to(octetra::MeshSeries& series, double time) const {
        std::vector<double> density = heat_;
        for (std::size_t c = 0; c < density.size(); ++c)
            density[c] /= octetra::volume(corners_of(c));
        mesh_.append_to(series, time,
                        std::array{od::Field{"density", octetra::FieldOn::cells, 1, density}});
    }

    // Returns the relative difference between the total heat and the heat deposited.
    double drift() const {
        std::array<double, 2> sums{std::accumulate(heat_.begin(), heat_.end(), 0.0), left_};
        MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return std::abs(sums[0] - sums[1]) / sums[1];
    }

private:
    // Transfers the heat of cells over a step. Returns whether the step changed the mesh.
    bool take(const od::Adaptation& step, Seconds& seconds) {
        heat_ = timed(seconds.transfer, [&] {
            return step.transfer_cells(std::move(heat_), 1, od::CellValues::divided);
        });
        return step.changed;
    }

    std::vector<std::uint8_t> marked(const Front& front, auto&& is_marked) const {
        std::vector<std::uint8_t> marks(mesh_.cells().size());
        for (std::size_t c = 0; c < marks.size(); ++c) {
            const auto corners = corners_of(c);
            const double width = std::cbrt(octetra::volume(corners));
            marks[c] = is_marked(front.distance(octetra::centroid(corners)), width) ? 1 : 0;
        }
        return marks;
    }

    octetra::Corners corners_of(std::size_t c) const {
        octetra::Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh_.points()[mesh_.cells()[c][k].value()];
        }
        return corners;
    }

    od::AdaptiveMesh mesh_;
    std::vector<double> heat_;  // heat of each cell
    double left_ = 0;           // heat deposited on this process
};

// Prints a line of the table, with the maximum of the seconds over all processes.
void print_cycle(int cycle, const HeatedMesh& heated, const Seconds& seconds, double drift) {
    const od::Communicator& processes = heated.mesh().processes();
    const std::uint64_t here = heated.mesh().cells().size();
    const std::uint64_t cells = processes.sum(here);
    const std::uint64_t most = processes.max(here);
    std::array<double, 5> all{seconds.coarsen, seconds.refine, seconds.rebalance, seconds.transfer,
                              seconds.write};
    MPI_Allreduce(MPI_IN_PLACE, all.data(), 5, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    if (!processes.is_first()) return;
    const double mean = static_cast<double>(cells) / processes.size();
    std::printf("%5d %9llu %9.2f %9.3f %8.3f %9.3f %8.3f %8.3f %8.0e\n", cycle,
                static_cast<unsigned long long>(cells), static_cast<double>(most) / mean, all[0],
                all[1], all[2], all[3], all[4], drift);
}

void run(const char* input, int cycles, const std::string& name) {
    const od::Communicator processes = od::communicator_of(MPI_COMM_WORLD);
    HeatedMesh heated(od::AdaptiveMesh::read(processes, input));
    octetra::MeshSeries series(name + ".vtkhdf", processes);
    if (processes.is_first()) {
        std::printf(
            "cycle     cells most/mean   coarsen   refine rebalance transfer    write    drift\n");
    }
    double greatest = 0;
    for (int cycle = 1; cycle <= cycles; ++cycle) {
        const Front front{0.2 + 0.6 * cycle / cycles};
        Seconds seconds;
        heated.follow(front, seconds);
        heated.heat_up(front);
        timed(seconds.write, [&] { heated.append_to(series, cycle); });
        const double drift = heated.drift();
        greatest = std::max(greatest, drift);
        print_cycle(cycle, heated, seconds, drift);
    }
    (void)series.commit();
    (void)heated.mesh().write(name + ".mesh");
    if (!(greatest < 1e-12)) throw std::runtime_error("heat is not conserved");
    if (processes.is_first()) std::printf("heat is conserved up to rounding\n");
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int status = argc == 4 ? 0 : 2;
    if (argc != 4 && rank == 0) std::fprintf(stderr, "usage: moving_front INPUT CYCLES NAME\n");
    try {
        if (argc == 4) run(argv[1], std::atoi(argv[2]), argv[3]);
    } catch (const std::exception& error) {  // the same on all processes
        if (rank == 0) std::fprintf(stderr, "%s\n", error.what());
        status = 2;
    }
    MPI_Finalize();
    return status;
}
