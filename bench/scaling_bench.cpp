/// Input of a model of many ranks: `bench_scaling MESH uniform|sphere|moving OUT` reads a mesh of
/// the unit cube, adapts it, and writes it. Prints a line of JSON: for each rank and each stage
/// (reading, adapting, writing) the processor seconds outside MPI, messages, bytes, and collective
/// calls. Also wall-clock seconds, which are meaningful if each rank has its own processor. Also
/// under mpirun; bench/scaling makes a page from many runs.

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/profile.hpp>

#include "measuring.hpp"

namespace octetra::bench {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using nlohmann::ordered_json;

/// A shell about a point on the diagonal, which intersects some cells of a cube, but not most.
struct Shell {
    double center = 0.5;
    double radius = 0.3;
    double width = 0.01;

    [[nodiscard]] double distance(const Corners& corners) const {
        const Point p = centroid(corners);
        return std::abs(std::hypot(p.x - center, p.y - center, p.z - center) - radius);
    }
};

std::vector<std::uint8_t> marked(const AdaptiveMesh& mesh, auto&& is_marked) {
    std::vector<std::uint8_t> marks(mesh.cells().size());
    for (std::size_t c = 0; c < marks.size(); ++c) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = mesh.points()[mesh.cells()[c][k].value()];
        }
        marks[c] = is_marked(corners) ? 1 : 0;
    }
    return marks;
}

/// Refines to a 64th of the volume of the cells of the input.
void refine_near(AdaptiveMesh& mesh, const Shell& shell, double finest) {
    for (bool changes = true; changes;) {
        changes =
            mesh.refine(marked(mesh,
                               [&](const Corners& at) {
                                   return shell.distance(at) < shell.width && volume(at) > finest;
                               }))
                .changed;
        (void)mesh.rebalance();
    }
}

void adapt(AdaptiveMesh& mesh, const std::string& what, std::uint64_t cells_read) {
    if (what == "uniform") {
        (void)mesh.refine({.all = true});
        return;
    }
    const double finest = 1.0 / 63 / static_cast<double>(cells_read);
    Shell shell;
    refine_near(mesh, shell, finest);
    if (what == "sphere") return;
    for (int cycle = 0; cycle < 3; ++cycle) {
        shell.center += 0.01;
        for (int k = 0; k < 2; ++k) {
            (void)mesh.coarsen(marked(
                mesh, [&](const Corners& at) { return shell.distance(at) > 2 * shell.width; }));
        }
        refine_near(mesh, shell, finest);
    }
}

enum Stage { reading, adapting, writing, stage_count };
constexpr std::array<const char*, stage_count> stage_names{"reading", "adapting", "writing"};

/// The stage of a phase, by the names that the library uses.
Stage stage_of(const distributed::ProfiledPhase& phase) {
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
        return std::ranges::find(names, phase.name) != names.end();
    };
    const bool is_of_no_level = phase.level == 0;
    if (is_one_of({"read", "partition", "distribute"})) return reading;
    if (is_one_of({"interfaces", "sharers"}) && is_of_no_level) return reading;
    if (is_one_of({"number vertices"}) && is_of_no_level) return writing;
    return is_one_of({"write"}) ? writing : adapting;
}

ordered_json of_each_rank(const std::vector<distributed::PhaseCounts>& ranks, auto member) {
    auto list = ordered_json::array();
    for (const auto& counts : ranks) list.push_back(counts.*member);
    return list;
}

/// Collective; returns the counts on the first rank.
ordered_json counts_of_stages(const Communicator& processes) {
    using distributed::PhaseCounts;
    const auto profile = distributed::gather_profile(processes);
    const std::size_t ranks = profile.seconds_of_rank.size();
    std::array<std::vector<PhaseCounts>, stage_count> sums;
    for (auto& of_stage : sums) of_stage.resize(ranks);
    for (const auto& phase : profile.phases) {
        for (std::size_t r = 0; r < ranks; ++r) {
            PhaseCounts& sum = sums[stage_of(phase)][r];
            sum.computing_seconds += phase.of_rank[r].computing_seconds;
            sum.messages += phase.of_rank[r].messages;
            sum.bytes += phase.of_rank[r].bytes;
            sum.collectives += phase.of_rank[r].collectives;
        }
    }
    ordered_json result{{"peak_memory_bytes", profile.peak_memory_of_rank}};
    for (std::size_t s = 0; s < stage_count; ++s) {
        result[stage_names[s]] = {
            {"computing_seconds", of_each_rank(sums[s], &PhaseCounts::computing_seconds)},
            {"messages", of_each_rank(sums[s], &PhaseCounts::messages)},
            {"bytes", of_each_rank(sums[s], &PhaseCounts::bytes)},
            {"collectives", of_each_rank(sums[s], &PhaseCounts::collectives)}};
    }
    return result;
}

/// Collective. Wall-clock seconds from barrier to barrier.
double seconds_of(const Communicator& world, auto&& work) {
    (void)world.max(0);
    const double start = wall_seconds();
    work();
    (void)world.max(0);
    return wall_seconds() - start;
}

void measure(const Communicator& world, const std::string& path, const std::string& what,
             const std::string& out) {
    const Communicator measured = distributed::profiled(world, distributed::ProfileDetail::sums,
                                                        distributed::ProfileClock::processor);
    std::optional<AdaptiveMesh> mesh;
    std::array<double, stage_count> seconds{};
    seconds[reading] = seconds_of(world, [&] { mesh = AdaptiveMesh::read(measured, path); });
    const std::uint64_t read = world.sum(mesh->cells().size());
    seconds[adapting] = seconds_of(world, [&] { adapt(*mesh, what, read); });
    const std::uint64_t cells = world.sum(mesh->cells().size());
    const std::uint64_t most = world.max(mesh->cells().size());
    seconds[writing] = seconds_of(world, [&] {
        const distributed::Phase phase(measured, "write");
        (void)mesh->write(out);
    });
    ordered_json result = counts_of_stages(measured);
    if (!world.is_first()) return;
    for (std::size_t s = 0; s < stage_count; ++s) {
        result[stage_names[s]]["wall_seconds"] = seconds[s];
    }
    result.update({{"case", what},
                   {"ranks", world.size()},
                   {"cells_read", read},
                   {"cells", cells},
                   {"most_cells", most}});
    fmt::print("{}\n", result.dump());
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    if (argc != 4) return 2;
    octetra::bench::measure(session.world(), argv[1], argv[2], argv[3]);
}
