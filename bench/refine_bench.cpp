/// The distributed engine, barrier to barrier: `bench_refine N LEVELS [SPHERE_RADIUS]` refines a
/// Kuhn cube of N^3 cubes uniformly, or inside a sphere about its centre. Also under mpirun.

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>

#include <fmt/format.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::uint64_t peak_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void measure(const distributed::Communicator& world, std::size_t n, int levels, double radius) {
    Mesh cube;
    if (world.is_first()) cube = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const auto parts = distributed::partition_cells(
        cube, world.size(), {.method = distributed::PartitionMethod::block});
    auto mesh = distributed::distribute(world, std::move(cube), parts);
    Selection selection{.all = radius <= 0};
    if (radius > 0) selection.spheres.push_back({{0.5, 0.5, 0.5}, radius});
    for (int level = 1; level <= levels; ++level) {
        const auto before = world.sum(mesh.cells.size());
        const double start = seconds_now();
        const auto counts = distributed::refine(mesh, selection, {.levels = 1});
        const auto cells = world.sum(mesh.cells.size());
        const double seconds = seconds_now() - start;
        const auto peak = world.max(peak_bytes());
        if (!world.is_first()) continue;
        fmt::print(
            "level {}: {:>10} -> {:>10} cells {:8.3f} s {:7.2f} M output cells/s, {:7.2f} M new "
            "cells/s, {} rounds, peak {:.0f} MB a rank\n",
            level, before, cells, seconds, static_cast<double>(cells) / seconds * 1e-6,
            static_cast<double>(cells - before) / seconds * 1e-6, counts.rounds,
            static_cast<double>(peak) * 1e-6);
    }
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    // `./dev bench` passes the arguments of Google Benchmark to all.
    if (argc > 1 && argv[1][0] == '-') argc = 1;
    const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 55;
    const int levels = argc > 2 ? std::atoi(argv[2]) : 1;
    const double radius = argc > 3 ? std::atof(argv[3]) : 0;
    octetra::measure(session.world(), n, levels, radius);
}
