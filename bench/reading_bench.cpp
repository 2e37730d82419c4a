/// Loading of a mesh: `bench_reading MESH [PARTITION]` reads, partitions and distributes a mesh,
/// and prints the seconds of each phase, from barrier to barrier and on the slowest rank, and the
/// peak memory of each rank. One measurement per run, because a process's peak never decreases.
/// Also under mpirun.

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/profile.hpp>
#include <octetra/distributed/read_parts.hpp>

#include "measuring.hpp"

namespace octetra::bench {
namespace {

using distributed::Communicator;

void print_memory(const std::vector<std::vector<std::uint64_t>>& peaks, std::uint64_t idle) {
    std::uint64_t most = 0;
    std::uint64_t sum = 0;
    fmt::print("MB of each rank:");
    for (const auto& one : peaks) {
        fmt::print(" {:.1f}", static_cast<double>(one.front()) * 1e-6);
        most = std::max(most, one.front());
        sum += one.front();
    }
    fmt::print("; most / mean {:.2f}; before reading the first had {:.1f}\n",
               static_cast<double>(most * peaks.size()) / static_cast<double>(sum),
               static_cast<double>(idle) * 1e-6);
}

void measure(const Communicator& all, const std::string& path, const std::string& partition) {
    const Communicator world = distributed::profiled(all, distributed::ProfileDetail::sums);
    const std::uint64_t idle = peak_bytes();
    (void)world.max(0);
    const double start = wall_seconds();
    const auto mesh = distributed::read_parts(world, path, distributed::parse_partition(partition));
    (void)world.max(0);
    const double seconds = wall_seconds() - start;
    const auto profile = distributed::gather_profile(world);
    const auto peaks = world.gather(std::vector<std::uint64_t>{peak_bytes()});
    if (world.is_first()) {
        fmt::print("{} by {}, {} ranks: {:.3f} s; ", path, partition, world.size(), seconds);
        print_memory(peaks, idle);
        for (const distributed::ProfiledPhase& phase : profile.phases) {
            double computing = 0;
            double communicating = 0;
            for (const auto& counts : phase.of_rank) {
                computing = std::max(computing, counts.computing_seconds);
                communicating = std::max(communicating, counts.communicating_seconds);
            }
            fmt::print("    {:<12} {:.3f} s, {:.3f} s in MPI\n", phase.name, computing,
                       communicating);
        }
    }
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    if (argc < 2) return 2;
    octetra::bench::measure(session.world(), argv[1], argc > 2 ? argv[2] : "rcb");
}
