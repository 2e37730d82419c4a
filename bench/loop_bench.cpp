/// The overhead of the library over the engine: `bench_loop [CUBES [MARKED]]` refines CUBES^3 cubes
/// of six cells uniformly, by the engine and by an AdaptiveMesh, and prints the minimum of three
/// times; the memory that a rank needs for this, without meshes that the program has moved from;
/// the times of the parts of the library's step that the engine does not have; and the times of
/// steps by both with about MARKED marked cells, in a ball at a different position each time.
/// Seconds are those of the slowest rank, from barrier to barrier. Also under mpirun.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <string_view>
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

/// Peak memory of a uniform step by an AdaptiveMesh: the maximum over the ranks.
void measure_memory(const Communicator& world, std::size_t cubes) {
    AdaptiveMesh mesh = [&] {
        const Input input(world, cubes);
        return AdaptiveMesh::distribute(world, input.mesh, input.ranks);
    }();
    std::vector<std::uint8_t> marks(mesh.cells().size(), 1);
    (void)::malloc_trim(0);
    (void)peak_bytes_since_last();
    (void)mesh.refine(marks);
    const auto tenths = world.max(10 * peak_bytes_since_last() / mesh.cells().size());
    if (!world.is_first()) return;
    fmt::print("peak memory: {:.1f} bytes a cell\n", 0.1 * static_cast<double>(tenths));
}

/// Seconds of the slowest rank in the phases with these names.
double seconds_in(const distributed::GatheredProfile& profile,
                  std::initializer_list<std::string_view> names) {
    double most = 0;
    for (std::size_t r = 0; r < profile.seconds_of_rank.size(); ++r) {
        double seconds = 0;
        for (const distributed::ProfiledPhase& phase : profile.phases) {
            if (std::ranges::find(names, phase.name) == names.end()) continue;
            seconds += phase.of_rank[r].computing_seconds + phase.of_rank[r].communicating_seconds;
        }
        most = std::max(most, seconds);
    }
    return most;
}

/// The additional work of the library's uniform step, as fractions of the engine's time; the
/// minimum of three.
void measure_parts(const Communicator& all, const Input& input, double engine) {
    double numbers = std::numeric_limits<double>::infinity();
    double maps = numbers;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const auto world = distributed::profiled(all, distributed::ProfileDetail::sums);
        AdaptiveMesh mesh = AdaptiveMesh::distribute(world, input.mesh, input.ranks);
        (void)mesh.refine(std::vector<std::uint8_t>(mesh.cells().size(), 1));
        const distributed::GatheredProfile profile = distributed::gather_profile(world);
        numbers = std::min(numbers, seconds_in(profile, {"number vertices", "sharers"}));
        maps = std::min(maps, seconds_in(profile, {"maps"}));
    }
    if (!all.is_first()) return;
    fmt::print(
        "of the engine's seconds: sharers, owners and global numbers {:.1f} %, maps {:.1f} %\n",
        100 * numbers / engine, 100 * maps / engine);
}

/// Returns the seconds of the engine's uniform step.
double measure_uniform(const Communicator& world, const Input& input) {
    constexpr double never = std::numeric_limits<double>::infinity();
    double engine = never;
    double library = never;
    double transfer = never;
    double coarsening = never;
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
        step = distributed::Adaptation();
        coarsening = std::min(
            coarsening, seconds_of(world, [&] { (void)mesh.coarsen(Selection{.all = true}); }));
    }
    if (world.is_first()) {
        fmt::print(
            "uniform: engine {:.3f} s, library {:.3f} s ({:.2f}), transfer {:.3f} s; taken back in "
            "{:.3f} s\n",
            engine, library, library / engine, transfer, coarsening);
    }
    return engine;
}

/// A ball that contains about this number of cells of the lattice.
Sphere ball(std::size_t cubes, std::size_t cells, int step) {
    constexpr double pi = 3.14159265358979323846;
    const double centre = 0.15 * (step + 1);
    const double in_cubes = std::cbrt(static_cast<double>(cells) / (6 * 4.0 / 3 * pi));
    return {{centre, centre, centre}, in_cubes / static_cast<double>(cubes)};
}

/// The marks that a solver's estimator would return.
std::vector<CellIndex> marks_of(const Selection& selection, const AdaptiveMesh& mesh) {
    std::vector<CellIndex> marked;
    const auto points = mesh.points();
    const auto cells = mesh.cells();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& [a, b, c, d] = cells[i];
        const Corners corners{points[a.value()], points[b.value()], points[c.value()],
                              points[d.value()]};
        if (octetra::marks(selection, corners, 0, GlobalCell{0})) marked.push_back(CellIndex{i});
    }
    return marked;
}

/// The same marks as a byte for each cell.
std::vector<std::uint8_t> bytes_of(const std::vector<CellIndex>& marked, const AdaptiveMesh& mesh) {
    std::vector<std::uint8_t> bytes(mesh.cells().size(), 0);
    for (const CellIndex c : marked) bytes[c.value()] = 1;
    return bytes;
}

struct Seconds {
    double step = 0;  ///< with transfer of values
    double transfer = 0;
};

/// A mesh with values on its vertices and cells.
struct Solver {
    AdaptiveMesh mesh;
    std::vector<double> u;
    std::vector<double> q;

    Solver(const Communicator& world, const Input& input)
        : mesh(AdaptiveMesh::distribute(world, input.mesh, input.ranks)),
          u(mesh.points().size(), 1),
          q(mesh.cells().size(), 1) {}

    Seconds step(const Communicator& world, const auto& marks) {
        Seconds seconds;
        seconds.step = seconds_of(world, [&] {
            const distributed::Adaptation adaptation = mesh.refine(marks);
            seconds.transfer = seconds_of(world, [&] {
                u = adaptation.transfer_vertices(std::move(u));
                q = adaptation.transfer_cells(std::move(q));
            });
        });
        return seconds;
    }
};

void measure_small(const Communicator& world, const Input& input, std::size_t cubes,
                   std::size_t marked, double uniform) {
    DistributedMesh of_engine = distributed::distribute(world, input.mesh, input.ranks);
    Solver by_list(world, input);
    Solver by_bytes(world, input);
    AdaptiveMesh& mesh = by_list.mesh;
    for (int step = 0; step < 5; ++step) {
        Selection selection;
        selection.spheres.push_back(ball(cubes, marked, step));
        const auto before = world.sum(mesh.cells().size());
        const double engine = seconds_of(
            world, [&] { (void)distributed::refine(of_engine, selection, {.levels = 1}); });
        const std::vector<CellIndex> chosen = marks_of(selection, mesh);
        const std::vector<std::uint8_t> bytes = bytes_of(chosen, mesh);
        const Seconds list = by_list.step(world, chosen);
        const Seconds byte = by_bytes.step(world, bytes);
        const auto cells = world.sum(mesh.cells().size());
        if (world.is_first()) {
            fmt::print(
                "step {}: {} new cells; engine {:.2f} ms; library by a list of marked cells {:.2f} "
                "ms, of which transfer {:.2f} ms, {:.2f} % of a uniform step; by a byte for each "
                "cell {:.2f} ms, {:.2f} ms, {:.2f} %\n",
                step + 1, cells - before, 1e3 * engine, 1e3 * list.step, 1e3 * list.transfer,
                100 * list.step / uniform, 1e3 * byte.step, 1e3 * byte.transfer,
                100 * byte.step / uniform);
        }
    }
    const auto before = world.sum(mesh.cells().size());
    Selection selection;
    selection.spheres.push_back(ball(cubes, 8 * marked, 4));
    const std::vector<std::uint8_t> may_coarsen = bytes_of(marks_of(selection, mesh), mesh);
    const double seconds = seconds_of(world, [&] { (void)mesh.coarsen(may_coarsen); });
    const auto cells = world.sum(mesh.cells().size());
    if (world.is_first()) {
        fmt::print("{} cells fewer by coarsening: {:.2f} ms\n", before - cells, 1e3 * seconds);
    }
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 87;
    const std::size_t marked = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000;
    octetra::bench::measure_memory(session.world(), cubes);
    const octetra::bench::Input input(session.world(), cubes);
    const double uniform = octetra::bench::measure_uniform(session.world(), input);
    octetra::bench::measure_parts(session.world(), input, uniform);
    octetra::bench::measure_small(session.world(), input, cubes, marked, uniform);
}
