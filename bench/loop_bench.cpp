/// What the library adds to the engine: `bench_loop [CUBES [MARKED]]` refines CUBES^3 cubes a Kuhn
/// cube uniformly, by the engine and by an AdaptiveMesh, and takes a step of so many marked cells.
/// Seconds are those of the slowest rank, barrier to barrier, the least of three. Also under
/// mpirun.

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::DistributedMesh;

double seconds_of(const Communicator& world, auto&& work) {
    (void)world.max(0);
    const double start = wall_seconds();
    work();
    (void)world.max(0);
    return wall_seconds() - start;
}

struct Input {
    Mesh mesh;
    std::vector<int> ranks;

    Input(const Communicator& world, std::size_t cubes) {
        if (!world.is_first()) return;
        mesh = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
        ranks = distributed::partition_cells(mesh, world.size(),
                                             {.method = distributed::PartitionMethod::block});
    }
};

void measure_uniform(const Communicator& world, const Input& input) {
    constexpr double never = std::numeric_limits<double>::infinity();
    double engine = never;
    double library = never;
    double transfer = never;
    double per_cell = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
        {
            DistributedMesh mesh = distributed::distribute(world, input.mesh, input.ranks);
            engine = std::min(engine, seconds_of(world, [&] {
                                  (void)distributed::refine(mesh, {.all = true}, {.levels = 1});
                              }));
        }
        AdaptiveMesh mesh = AdaptiveMesh::distribute(world, input.mesh, input.ranks);
        const std::vector<std::uint8_t> marks(mesh.cells().size(), 1);
        std::vector<double> u(mesh.points().size(), 1);
        std::vector<double> q(mesh.cells().size(), 1);
        distributed::Adaptation step;
        library = std::min(library, seconds_of(world, [&] { step = mesh.refine(marks); }));
        transfer = std::min(transfer, seconds_of(world, [&] {
                                u = step.transfer_vertices(std::move(u));
                                q = step.transfer_cells(std::move(q));
                            }));
        per_cell = static_cast<double>(peak_bytes()) / static_cast<double>(mesh.cells().size());
    }
    if (!world.is_first()) return;
    fmt::print(
        "uniform: engine {:.3f} s, library {:.3f} s ({:.2f}), transfer {:.3f} s; peak memory "
        "{:.0f} bytes a cell\n",
        engine, library, library / engine, transfer, per_cell);
}

void measure_small(const Communicator& world, const Input& input, std::size_t marked) {
    AdaptiveMesh mesh = AdaptiveMesh::distribute(world, input.mesh, input.ranks);
    std::vector<double> u(mesh.points().size(), 1);
    std::vector<double> q(mesh.cells().size(), 1);
    const auto share = marked / static_cast<std::size_t>(world.size());
    for (int step = 0; step < 4; ++step) {
        // Cells that stand together, somewhere else each time.
        std::vector<std::uint8_t> marks(mesh.cells().size(), 0);
        const std::size_t begin = marks.size() / 8 * static_cast<std::size_t>(step + 1);
        std::fill_n(marks.begin() + static_cast<std::ptrdiff_t>(begin),
                    std::min(share, marks.size() - begin), std::uint8_t{1});
        const double seconds = seconds_of(world, [&] {
            const distributed::Adaptation adaptation = mesh.refine(marks);
            u = adaptation.transfer_vertices(std::move(u));
            q = adaptation.transfer_cells(std::move(q));
        });
        const auto cells = world.sum(mesh.cells().size());
        if (world.is_first()) {
            fmt::print("{} marked, step {}: {:.5f} s with maps and transfer, {} cells\n", marked,
                       step + 1, seconds, cells);
        }
    }
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 55;
    const std::size_t marked = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000;
    const octetra::bench::Input input(session.world(), cubes);
    octetra::bench::measure_uniform(session.world(), input);
    octetra::bench::measure_small(session.world(), input, marked);
}
