/// Times of the distributed engine, from barrier to barrier: `bench_refine MESH [LEVELS [RADIUS]]`
/// refines a mesh file, or a Kuhn cube of MESH^3 cubes, uniformly or inside a sphere about (1/2,
/// 1/2, 1/2); each level is a separate call. `--json` prints a line for bench/run/. Also under
/// mpirun.

#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/refine.hpp>

#include "level/tuning.hpp"
#include "measuring.hpp"
#include "pattern_tables.hpp"
#include "reserve_memory.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using distributed::Communicator;
using distributed::DistributedMesh;
using nlohmann::ordered_json;

struct Options {
    std::string mesh = "55";  ///< a file, or how many cubes a side
    int levels = 1;
    double radius = 0;  ///< 0: all cells
    double random = 0;  ///< this fraction of the cells, at random
    std::string partition = "block";
    bool apart = false;
    bool warm = false;
    bool profile = false;
    bool memcpy = false;
    std::size_t at_hand_megabytes = 0;
    distributed::Tuning tuning;
    bool json = false;
};

Mesh mesh_of(const std::string& name) {
    char* end = nullptr;
    const std::size_t n = std::strtoul(name.c_str(), &end, 10);
    if (*end != '\0') return read_mesh(name);
    return test::kuhn(n, n, n, 1.0 / static_cast<double>(n));
}

Selection selection_of(const Options& options) {
    Selection selection{.all = options.radius <= 0 && options.random <= 0};
    if (options.radius > 0) selection.spheres.push_back({{0.5, 0.5, 0.5}, options.radius});
    if (options.random > 0) selection.random = RandomShare{options.random, 1};
    return selection;
}

/// The sum over all ranks.
double sum_of(const Communicator& world, double seconds) {
    return static_cast<double>(world.sum(static_cast<std::uint64_t>(seconds * 1e9))) * 1e-9;
}

/// Collective. Makes one level; processor seconds, messages and bytes are sums over all ranks.
ordered_json refine_level(const Communicator& world, DistributedMesh& mesh,
                          const Selection& selection, const distributed::Tuning& tuning) {
    const auto before = world.sum(mesh.cells.size());
    const double processor = processor_seconds();
    const double start = wall_seconds();
    const auto counts = distributed::refine(mesh, selection, {.levels = 1}, tuning);
    const auto cells = world.sum(mesh.cells.size());
    const double seconds = wall_seconds() - start;
    const double used = processor_seconds() - processor;
    return {{"before", before},
            {"cells", cells},
            {"seconds", seconds},
            {"processor_seconds", sum_of(world, used)},
            {"rounds", counts.rounds},
            {"messages", world.sum(counts.messages)},
            {"bytes", world.sum(counts.bytes)},
            {"peak_bytes", world.max(peak_bytes())}};
}

/// Collective; returns the profile on the first rank. Seconds are means over the ranks, other
/// figures sums.
ordered_json profile_of(const Communicator& processes) {
    const auto profile = distributed::gather_profile(processes);
    distributed::PhaseCounts sum;
    double synchronising = 0;
    for (const auto& phase : profile.phases) {
        for (const auto& rank : phase.of_rank) {
            sum.computing_seconds += rank.computing_seconds;
            sum.communicating_seconds += rank.communicating_seconds;
            sum.messages += rank.messages;
            sum.bytes += rank.bytes;
            sum.collectives += rank.collectives;
            sum.collective_bytes += rank.collective_bytes;
            if (phase.name == "synchronise") {
                synchronising += rank.computing_seconds + rank.communicating_seconds;
            }
        }
    }
    const double ranks = processes.size();
    return {{"computing_seconds", sum.computing_seconds / ranks},
            {"communicating_seconds", sum.communicating_seconds / ranks},
            {"synchronising_seconds", synchronising / ranks},
            {"messages", sum.messages},
            {"bytes", sum.bytes},
            {"collectives", sum.collectives},
            {"collective_bytes", sum.collective_bytes}};
}

std::size_t bytes_of(const DistributedMesh& mesh) {
    return mesh.points.size() * sizeof(Point) + mesh.cells.size() * sizeof(CellVertices);
}

/// The time of copying this number of bytes: into memory that the process has not used before, as
/// in a refinement, and into memory that was written before.
ordered_json memcpy_seconds(std::size_t bytes) {
    const std::vector<char> from(bytes, 1);
    // NOLINTNEXTLINE(modernize-avoid-c-arrays): a vector would write it
    const std::unique_ptr<char[]> to(new char[bytes]);  // not written yet
    ordered_json seconds;
    for (const char* into : {"new", "used"}) {
        const double start = wall_seconds();
        std::memcpy(to.get(), from.data(), bytes);
        asm volatile("" : : "r"(to.get()) : "memory");  // so that it is not optimised away
        seconds[into] = wall_seconds() - start;
    }
    return seconds;
}

void print_level(int number, const ordered_json& level) {
    const auto before = level["before"].get<double>();
    const auto cells = level["cells"].get<double>();
    const auto seconds = level["seconds"].get<double>();
    fmt::print(
        "level {}: {:>10} -> {:>10} cells {:8.3f} s {:7.2f} M output cells/s, {:7.2f} M new "
        "cells/s, {} rounds, peak {:.0f} MB a rank\n",
        number, before, cells, seconds, cells / seconds * 1e-6, (cells - before) / seconds * 1e-6,
        level["rounds"].get<int>(), level["peak_bytes"].get<double>() * 1e-6);
}

void measure(const Communicator& world, const Options& options) {
    if (options.at_hand_megabytes > 0) reserve_memory(options.at_hand_megabytes << 20U);
    const Communicator group = options.apart ? Communicator() : world;
    Mesh input = group.is_first() ? mesh_of(options.mesh) : Mesh{};
    std::vector<int> parts;
    if (group.is_first()) {
        parts =
            partition_cells(input, group.size(), distributed::parse_partition(options.partition));
    }
    auto mesh = distributed::distribute(group, std::move(input), parts);
    if (options.profile) {
        mesh.processes = distributed::profiled(group, distributed::ProfileDetail::sums);
    }

    if (options.warm) make_pattern_tables();

    const std::size_t input_bytes = bytes_of(mesh);
    ordered_json line{{"program", "octetra"}, {"ranks", world.size()}};
    for (int level = 1; level <= options.levels; ++level) {
        line["levels"].push_back(refine_level(world, mesh, selection_of(options), options.tuning));
        if (world.is_first() && !options.json) print_level(level, line["levels"].back());
    }
    line["peak_bytes"] = world.max(peak_bytes());
    if (options.profile) line["profile"] = profile_of(mesh.processes);
    if (options.memcpy) {
        line["array_bytes"] = input_bytes + bytes_of(mesh);
        line["memcpy_seconds"] = memcpy_seconds(input_bytes + bytes_of(mesh));
    }
    if (world.is_first() && options.json) fmt::print("{}\n", line.dump());
}

int run(const Communicator& world, int argc, char** argv) {
    CLI::App app("Measures the distributed engine, barrier to barrier");
    Options options;
    app.add_option("mesh", options.mesh, "a mesh file, or N: N^3 cubes of six cells");
    app.add_option("levels", options.levels);
    app.add_option("radius", options.radius, "only cells nearer to (1/2, 1/2, 1/2); 0: all");
    app.add_option("--random", options.random, "this share of the cells, at random");
    app.add_option("--partition", options.partition, "as of octetra refine");
    app.add_flag("--apart", options.apart,
                 "each rank has a mesh of its own, and nothing to do with the others");
    app.add_flag("--warm", options.warm, "leave out what a program does but once");
    app.add_option("--memory-at-hand", options.at_hand_megabytes,
                   "so many MiB for each rank, written to before: as in a program's later levels");
    app.add_option(
        "--incremental-below", options.tuning.incremental_below,
        "incremental levels where marked cells have less than this share of the vertices");
    app.add_flag("--profile", options.profile, "with --json: seconds of synchronisation, bytes");
    app.add_flag("--memcpy", options.memcpy, "with --json: what copying the mesh's arrays takes");
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
