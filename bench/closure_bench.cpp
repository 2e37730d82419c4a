/// The time of the regular closure beside that of longest edges: `bench_closure [CUBES [MARKED]]`.
/// First, the levels over a sphere in a lattice of (CUBES / 2)^3 cubes of six cells: seconds, cells
/// and seconds per million new cells of each. Then, in a lattice of CUBES^3 cubes, a uniform level,
/// and steps in which about MARKED cells are marked at random. Seconds are those of the slowest
/// rank, from barrier to barrier. Also under mpirun.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/profile.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using distributed::StepOptions;

constexpr std::array closures{std::pair{Closure::longest_edge, "longest edges"},
                              std::pair{Closure::regular, "regular"}};

double seconds_of(const Communicator& world, auto&& work) {
    (void)world.max(0);
    const double start = wall_seconds();
    work();
    (void)world.max(0);
    return wall_seconds() - start;
}

AdaptiveMesh lattice(const Communicator& world, std::size_t cubes) {
    Mesh mesh;
    std::vector<int> ranks;
    if (world.is_first()) {
        mesh = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
        ranks = distributed::partition_cells(mesh, world.size(),
                                             {.method = distributed::PartitionMethod::block});
    }
    return AdaptiveMesh::distribute(world, std::move(mesh), ranks);
}

std::uint64_t cells_of(const Communicator& world, const AdaptiveMesh& mesh) {
    return world.sum(mesh.cells().size());
}

void measure_sphere(const Communicator& world, std::size_t cubes) {
    const Selection sphere{.spheres = {Sphere{{0.5, 0.5, 0.5}, 0.3}}};
    for (const auto& [closure, name] : closures) {
        AdaptiveMesh mesh = lattice(world, cubes);
        const StepOptions options{.closure = closure};
        for (int level = 1; level <= 3; ++level) {
            const std::uint64_t before = cells_of(world, mesh);
            const double seconds = seconds_of(world, [&] { (void)mesh.refine(sphere, options); });
            const std::uint64_t after = cells_of(world, mesh);
            if (!world.is_first()) continue;
            fmt::print(
                "sphere, level {}, {:13}: {:.3f} s, {} cells, {:.3f} s per million new ones\n",
                level, name, seconds, after, 1e6 * seconds / static_cast<double>(after - before));
        }
    }
}

/// Marks each cell with the same probability, `marked` in all.
std::vector<CellIndex> scattered(const Communicator& world, const AdaptiveMesh& mesh,
                                 std::size_t marked, std::uint32_t seed) {
    const double probability =
        static_cast<double>(marked) / static_cast<double>(cells_of(world, mesh));
    std::mt19937 random(seed + 1000U * static_cast<std::uint32_t>(world.rank()));
    std::bernoulli_distribution is_marked(probability);
    std::vector<CellIndex> cells;
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        if (is_marked(random)) cells.push_back(CellIndex{c});
    }
    return cells;
}

void measure_scattered(const Communicator& world, std::size_t cubes, std::size_t marked) {
    double uniform = 0;
    {
        AdaptiveMesh mesh = lattice(world, cubes);
        uniform = seconds_of(world, [&] { (void)mesh.refine(Selection{.all = true}); });
    }
    if (world.is_first()) fmt::print("uniform level: {:.3f} s\n", uniform);
    for (const auto& [closure, name] : closures) {
        AdaptiveMesh mesh = lattice(world, cubes);
        for (std::uint32_t step = 1; step <= 6; ++step) {
            const std::vector<CellIndex> marks = scattered(world, mesh, marked, step);
            const StepOptions options{.closure = closure};
            const double seconds = seconds_of(world, [&] { (void)mesh.refine(marks, options); });
            const std::uint64_t cells = cells_of(world, mesh);
            if (!world.is_first()) continue;
            fmt::print(
                "scattered, step {}, {:13}: {:.4f} s ({:.1f} % of a uniform level), {} cells\n",
                step, name, seconds, 100 * seconds / uniform, cells);
        }
    }
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 80;
    const std::size_t marked = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000;
    octetra::bench::measure_sphere(session.world(), cubes / 2);
    octetra::bench::measure_scattered(session.world(), cubes, marked);
}
