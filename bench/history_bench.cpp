/// The cost of history: `bench_history [CUBES]` refines CUBES^3 cubes of six cells uniformly,
/// within a ball, and around a point. For each it prints the bytes of a checkpoint per bisected
/// cell; the cells per second of saving and loading, compared with the same mesh as TetGen files
/// and .vtu; and the times of extracting the steps from the mesh, of repeating them, and of
/// coarsening all cells by one generation, as fractions of the time of refinement. Each time is the
/// minimum of three. Also under mpirun.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "history/replay.hpp"
#include "history/steps_of.hpp"
#include "measuring.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::bench {
namespace {

using namespace distributed;

struct Case {
    const char* name;
    std::vector<Selection> steps;
};

std::vector<Case> cases() {
    Case ball{"within a ball", {}};
    for (int k = 0; k < 4; ++k) ball.steps.push_back({.spheres = {{{0.5, 0.5, 0.5}, 0.3}}});
    Case point{"around a point", {}};
    for (int k = 2; k < 14; ++k) {
        point.steps.push_back({.spheres = {{{0.5, 0.5, 0.5}, std::ldexp(1, -k)}}});
    }
    return {{"uniform", {{.all = true}, {.all = true}}}, ball, point};
}

/// From barrier to barrier; the minimum of three times.
double seconds_of(const Communicator& world, auto&& prepare, auto&& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 3; ++repeat) {
        auto prepared = prepare();
        (void)world.max(0);
        const double start = wall_seconds();
        work(prepared);
        (void)world.max(0);
        least = std::min(least, wall_seconds() - start);
    }
    return least;
}
double seconds_of(const Communicator& world, auto&& work) {
    return seconds_of(
        world, [] { return 0; }, [&](int) { work(); });
}

class Bench {
public:
    Bench(const Communicator& world, std::size_t cubes) : world_(world) {
        world.on_first([&] {
            folder_.emplace();
            input_ = test::kuhn(cubes, cubes, cubes, 1.0 / static_cast<double>(cubes));
            ranks_ = partition_cells(input_, world.size(), {.method = PartitionMethod::block});
        });
        std::string name = folder_ ? folder_->path().native() : std::string();
        std::vector<char> bytes(name.begin(), name.end());
        world.broadcast(bytes);
        path_ = std::string(bytes.begin(), bytes.end());
    }

    void run(const Case& of) const {
        const auto refine = [&](AdaptiveMesh& mesh) {
            for (const Selection& step : of.steps) (void)mesh.refine(step);
        };
        const auto input = [&] { return AdaptiveMesh::distribute(world_, input_, ranks_); };
        const auto refined = [&] {
            AdaptiveMesh mesh = input();
            refine(mesh);
            return mesh;
        };
        const double refining = seconds_of(world_, input, refine);
        const AdaptiveMesh mesh = refined();
        const double cells = static_cast<double>(world_.sum(mesh.cells().size()));
        const auto print = [&](const char* what, double seconds) {
            if (!world_.is_first()) return;
            fmt::print("  {:<34} {:8.3f} s  {:7.2f} million cells a second  {:6.2f} of refining\n",
                       what, seconds, 1e-6 * cells / seconds, seconds / refining);
        };
        const double saving = seconds_of(world_, [&] { mesh.save(path_ / "state.octetra"); });
        print_bytes(of.name, cells);
        print("refining", refining);
        print("save", saving);
        print("load", seconds_of(world_, [&] {
                  (void)AdaptiveMesh::load(world_, path_ / "state.octetra",
                                           {.method = PartitionMethod::rcb});
              }));
        for (const char* file : {"mesh.ele", "mesh.vtu"}) {
            print(fmt::format("write {}", file).c_str(),
                  seconds_of(world_, [&] { (void)mesh.write(path_ / file); }));
        }
        print("read mesh.ele, on the first rank", seconds_of(world_, [&] {
                  world_.on_first([&] { (void)read_mesh(path_ / "mesh.ele"); });
              }));
        measure_replay(of, print);
        print("all cells back by a generation",
              seconds_of(world_, refined, [](AdaptiveMesh& m) { (void)m.coarsen({.all = true}); }));
    }

private:
    void print_bytes(const char* name, double cells) const {
        if (!world_.is_first()) return;
        const CheckpointFacts facts = read_checkpoint_facts(path_ / "state.octetra");
        std::uint64_t cut = 0;
        std::uint64_t bytes = 0;
        for (const StepFacts& step : facts.steps) {
            cut += step.cells_cut;
            bytes += step.bytes;
        }
        fmt::print(
            "{}: {} steps, {:.0f} cells; {} cells cut, {} bytes of cuts, {:.3f} a cut cell\n", name,
            facts.steps.size(), cells, cut, bytes,
            static_cast<double>(bytes) / static_cast<double>(cut));
    }
    void measure_replay(const Case& of, auto&& print) const {
        DistributedMesh mesh = distribute(world_, input_, ranks_);
        for (const Selection& step : of.steps) (void)refine(mesh, step, {.levels = 1});
        restore_canonical_order(mesh);
        CutRoots cuts;
        print("read steps off the mesh", seconds_of(world_, [&] {
                  cuts = cut_roots_of(steps_of(mesh), mesh.cell_ancestors.first);
              }));
        print("replay", seconds_of(
                            world_, [&] { return distribute(world_, input_, ranks_); },
                            [&](DistributedMesh& again) { replay(again, cuts, of.steps.size()); }));
    }

    const Communicator& world_;
    std::optional<test::TemporaryFolder> folder_;
    std::filesystem::path path_;
    Mesh input_;
    std::vector<int> ranks_;
};

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 24;
    const octetra::bench::Bench bench(session.world(), cubes);
    for (const octetra::bench::Case& of : octetra::bench::cases()) bench.run(of);
}
