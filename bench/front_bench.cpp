/// A moving front: `bench_front [CUBES [CYCLES]]`. In CUBES^3 cubes of six cells a sphere moves
/// along the diagonal; each cycle coarsens cells far from its surface, refines cells near it to a
/// sixteenth of a cube's edge, and rebalances. Prints the seconds of each operation, from barrier
/// to barrier, with and without migration; the fraction of rebalancing; and the ratio of the
/// maximum to the mean number of cells per process after each cycle. Also under mpirun.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/orientation.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "measuring.hpp"
#include "support/meshes.hpp"

namespace octetra::bench {
namespace {

using namespace distributed;

struct Front {
    double center = 0;
    double radius = 0.25;
    double width = 0.02;

    [[nodiscard]] double distance(const Point& p) const {
        return std::abs(std::hypot(p.x - center, p.y - center, p.z - center) - radius);
    }
};

struct Seconds {
    double coarsen = 0;
    double refine = 0;
    double rebalance = 0;

    [[nodiscard]] double all() const { return coarsen + refine + rebalance; }
};

class Loop {
public:
    Loop(const Communicator& world, AdaptiveMesh mesh, double finest)
        : world_(&world), mesh_(std::move(mesh)), finest_volume_(finest) {}

    void cycle(const Front& front, bool balances) {
        time(seconds.coarsen, [&] {
            for (int k = 0; k < 2; ++k) {
                const auto marks = marked(
                    [&](double distance, double) { return distance > 2 * front.width; }, front);
                (void)mesh_.coarsen(marks);
            }
        });
        time(seconds.refine, [&] {
            for (int k = 0; k < 4; ++k) {
                const auto marks = marked(
                    [&](double distance, double volume) {
                        return distance < front.width && volume > finest_volume_;
                    },
                    front);
                if (!mesh_.refine(marks, {.scheme = Scheme::eight}).changed) break;
            }
        });
        if (balances) {
            time(seconds.rebalance, [&] { moves += mesh_.rebalance().changed() ? 1 : 0; });
        }
        const std::uint64_t here = mesh_.cells().size();
        const std::uint64_t all = world_->sum(here);
        cells += static_cast<double>(all);
        most_over_mean = std::max(most_over_mean, static_cast<double>(world_->max(here)) *
                                                      world_->size() / static_cast<double>(all));
    }

    Seconds seconds;
    int moves = 0;
    double cells = 0;           ///< summed over all cycles
    double most_over_mean = 1;  ///< maximum over the cycles

private:
    std::vector<std::uint8_t> marked(auto&& is_marked, const Front& front) const {
        std::vector<std::uint8_t> marks(mesh_.cells().size());
        for (std::size_t c = 0; c < marks.size(); ++c) {
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) {
                corners[k] = mesh_.points()[mesh_.cells()[c][k].value()];
            }
            marks[c] = is_marked(front.distance(centroid(corners)), volume(corners)) ? 1 : 0;
        }
        return marks;
    }
    void time(double& sum, auto&& work) const {
        (void)world_->max(0);
        const double start = wall_seconds();
        work();
        (void)world_->max(0);
        sum += wall_seconds() - start;
    }

    const Communicator* world_;
    AdaptiveMesh mesh_;
    double finest_volume_;
};

void measure(const Communicator& world, std::size_t cubes, int cycles, bool balances) {
    const double edge = 1.0 / static_cast<double>(cubes);
    Mesh input;
    std::vector<int> ranks;
    if (world.is_first()) {
        input = test::kuhn(cubes, cubes, cubes, edge);
        ranks = partition_cells(input, world.size(), {.method = PartitionMethod::rcb});
    }
    const double finest = edge * edge * edge / 6 / 64;
    Loop loop(world, AdaptiveMesh::distribute(world, std::move(input), ranks), finest);
    for (int k = 0; k < cycles; ++k) {
        const double along = static_cast<double>(k) / std::max(1, cycles - 1);
        loop.cycle({.center = 0.2 + 0.6 * along}, balances);
    }
    if (!world.is_first()) return;
    const Seconds& s = loop.seconds;
    fmt::print(
        "{}: {} cycles, {:.2f} million cells on average; coarsen {:.3f} s, refine {:.3f} s, "
        "rebalance {:.3f} s ({:.0f} % of all, {} times); {:.2f} million cells a second; most "
        "over mean {:.3f}\n",
        balances ? "moving" : "static", cycles, 1e-6 * loop.cells / cycles, s.coarsen, s.refine,
        s.rebalance, 100 * s.rebalance / s.all(), loop.moves, 1e-6 * loop.cells / s.all(),
        loop.most_over_mean);
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const std::size_t cubes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 24;
    const int cycles = argc > 2 ? std::atoi(argv[2]) : 30;
    for (const bool balances : {false, true}) {
        octetra::bench::measure(session.world(), cubes, cycles, balances);
    }
}
