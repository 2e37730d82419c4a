/// Few cells of many: `bench_local N LEVELS CHOSEN` refines a Kuhn cube of N^3 cubes around its
/// centre, level by level, each time about CHOSEN cells in a sphere half as large as the one
/// before; and says what each level takes of a uniform level of the same cube. Also under mpirun.

#include <time.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include <fmt/format.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

using distributed::Communicator;
using distributed::DistributedMesh;

/// Of this process. Waiting for other ranks counts, too.
double processor_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

DistributedMesh cube_of(const Communicator& world, std::size_t n) {
    Mesh cube;
    if (world.is_first()) cube = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const auto parts = distributed::partition_cells(
        cube, world.size(), {.method = distributed::PartitionMethod::block});
    return distributed::distribute(world, std::move(cube), parts);
}

/// One level: the most that a rank took, in milliseconds.
double level_milliseconds(DistributedMesh& mesh, const Selection& selection) {
    const double start = processor_seconds();
    (void)distributed::refine(mesh, selection, {.levels = 1});
    const double seconds = processor_seconds() - start;
    return static_cast<double>(mesh.processes.max(static_cast<std::uint64_t>(seconds * 1e9))) *
           1e-6;
}

/// The same, and how many cells all ranks looked at.
std::pair<double, std::uint64_t> profiled_level(DistributedMesh& mesh, const Selection& selection) {
    const Communicator world = mesh.processes;
    mesh.processes = distributed::profiled(world, distributed::ProfileDetail::sums);
    const double milliseconds = level_milliseconds(mesh, selection);
    std::uint64_t touched = 0;
    for (const auto& level : distributed::gather_profile(mesh.processes).levels) {
        touched = std::accumulate(level.cells_touched_of_rank.begin(),
                                  level.cells_touched_of_rank.end(), touched);
    }
    mesh.processes = world;
    return {milliseconds, touched};
}

void measure(const Communicator& world, std::size_t n, int levels, double chosen) {
    double uniform = 0;
    {
        DistributedMesh mesh = cube_of(world, n);
        (void)level_milliseconds(mesh, {});  // nothing: what a program does but once
        uniform = level_milliseconds(mesh, {.all = true});
        const auto cells = world.sum(mesh.cells.size());
        if (world.is_first()) {
            fmt::print("uniform: {:>10} cells {:9.2f} ms, {:6.0f} ns a cell\n", cells, uniform,
                       uniform * 1e6 / static_cast<double>(cells));
        }
    }
    DistributedMesh mesh = cube_of(world, n);
    constexpr double pi = 3.14159265358979323846;
    double radius = std::cbrt(chosen / (6 * 4.0 / 3 * pi)) / static_cast<double>(n);
    for (int level = 1; level <= levels; ++level, radius /= 2) {
        Selection selection;
        selection.spheres.push_back({{0.5, 0.5, 0.5}, radius});
        const auto before = world.sum(mesh.cells.size());
        const auto [milliseconds, touched] = profiled_level(mesh, selection);
        const auto cells = world.sum(mesh.cells.size());
        if (!world.is_first()) continue;
        fmt::print(
            "level {:>2}: {:>10} cells {:9.2f} ms, {:6.0f} ns a new cell, {:6.2f} % of "
            "uniform, {:>9} touched\n",
            level, cells, milliseconds, milliseconds * 1e6 / static_cast<double>(cells - before),
            100 * milliseconds / uniform, touched);
    }
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    // `./dev bench` passes the arguments of Google Benchmark to all.
    if (argc > 1 && argv[1][0] == '-') argc = 1;
    const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 88;
    const int levels = argc > 2 ? std::atoi(argv[2]) : 10;
    const double chosen = argc > 3 ? std::atof(argv[3]) : 1000;
    octetra::measure(session.world(), n, levels, chosen);
}
