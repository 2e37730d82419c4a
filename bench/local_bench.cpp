/// Refinement of few cells in a large mesh: `bench_local N LEVELS CHOSEN` refines a Kuhn cube of
/// N^3 cubes around its centre, level by level, each time about CHOSEN cells in a sphere of half
/// the previous radius. Prints the time of each level as a fraction of a uniform level of the same
/// cube. `--json` prints a line for bench/run/. Also under mpirun.

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "measuring.hpp"
#include "pattern_tables.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using distributed::Communicator;
using distributed::DistributedMesh;
using nlohmann::ordered_json;

struct Options {
    std::size_t cubes = 88;
    int levels = 10;
    double marked = 1000;
    bool json = false;
};

DistributedMesh cube_of(const Communicator& world, std::size_t n) {
    Mesh cube;
    if (world.is_first()) cube = test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
    const auto parts = distributed::partition_cells(
        cube, world.size(), {.method = distributed::PartitionMethod::block});
    return distributed::distribute(world, std::move(cube), parts);
}

/// Makes one level. Returns the maximum over the ranks, in milliseconds.
double level_milliseconds(DistributedMesh& mesh, const Selection& selection) {
    const double start = processor_seconds();
    (void)distributed::refine(mesh, selection, {.levels = 1});
    const double seconds = processor_seconds() - start;
    return static_cast<double>(mesh.processes.max(static_cast<std::uint64_t>(seconds * 1e9))) *
           1e-6;
}

/// The same, with the number of cells that all ranks processed.
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

/// Processor seconds of a uniform level, and its number of cells.
ordered_json uniform_level(const Communicator& world, std::size_t cubes) {
    DistributedMesh mesh = cube_of(world, cubes);
    const double milliseconds = level_milliseconds(mesh, {.all = true});
    return {{"cells", world.sum(mesh.cells.size())}, {"processor_seconds", milliseconds / 1000}};
}

ordered_json local_level(DistributedMesh& mesh, double radius) {
    Selection selection;
    selection.spheres.push_back({{0.5, 0.5, 0.5}, radius});
    const auto before = mesh.processes.sum(mesh.cells.size());
    const auto [milliseconds, touched] = profiled_level(mesh, selection);
    return {{"before", before},
            {"cells", mesh.processes.sum(mesh.cells.size())},
            {"processor_seconds", milliseconds / 1000},
            {"touched", touched}};
}

void print_level(int number, const ordered_json& level, double uniform) {
    const auto cells = level["cells"].get<double>();
    const auto seconds = level["processor_seconds"].get<double>();
    fmt::print(
        "level {:>2}: {:>10} cells {:9.2f} ms, {:6.0f} ns a new cell, {:6.2f} % of "
        "uniform, {:>9} touched\n",
        number, cells, 1e3 * seconds, 1e9 * seconds / (cells - level["before"].get<double>()),
        100 * seconds / uniform, level["touched"].get<std::uint64_t>());
}

void measure(const Communicator& world, const Options& options) {
    ordered_json line{{"program", "octetra"}, {"ranks", world.size()}};
    make_pattern_tables();
    line["uniform"] = uniform_level(world, options.cubes);
    const auto uniform = line["uniform"]["processor_seconds"].get<double>();
    const bool speaks = world.is_first() && !options.json;
    if (speaks) {
        const auto cells = line["uniform"]["cells"].get<double>();
        fmt::print("uniform: {:>10} cells {:9.2f} ms, {:6.0f} ns a cell\n", cells, 1e3 * uniform,
                   1e9 * uniform / cells);
    }
    DistributedMesh mesh = cube_of(world, options.cubes);
    constexpr double pi = 3.14159265358979323846;
    double radius =
        std::cbrt(options.marked / (6 * 4.0 / 3 * pi)) / static_cast<double>(options.cubes);
    for (int level = 1; level <= options.levels; ++level, radius /= 2) {
        line["levels"].push_back(local_level(mesh, radius));
        if (speaks) print_level(level, line["levels"].back(), uniform);
    }
    line["peak_bytes"] = world.max(peak_bytes());
    if (world.is_first() && options.json) fmt::print("{}\n", line.dump());
}

int run(const Communicator& world, int argc, char** argv) {
    CLI::App app("Measures what few cells of many cost, level by level");
    Options options;
    app.add_option("cubes", options.cubes, "N: N^3 cubes of six cells");
    app.add_option("levels", options.levels);
    app.add_option("marked", options.marked, "about how many cells are marked at each level");
    app.add_flag("--json", options.json, "print a line of JSON instead of words");
    CLI11_PARSE(app, argc, argv);
    measure(world, options);
    return 0;
}

}  // namespace
}  // namespace octetra::bench

// NOLINTNEXTLINE(bugprone-exception-escape): it ends this process, and mpirun then all others
int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    return octetra::bench::run(session.world(), argc, argv);
}
