/// Communication of synchronisation as a function of ranks and mesh size: `mpirun -n P
/// bench_communication [N]` refines a perturbed lattice of N^3 cubes once at random places, with
/// either synchronisation, and then lattices of half and twice the side. Prints counts, not times,
/// which are the same on any machine: messages per rank and round; bytes of all ranks, of the rank
/// that sends most, and per edge in the interfaces of all ranks.

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

using distributed::Synchronisation;

struct Figures {
    std::uint64_t cells = 0;       ///< before
    std::uint64_t fine_cells = 0;  ///< after
    std::uint64_t rounds = 0;
    std::uint64_t messages = 0;  ///< of all ranks
    std::uint64_t most_messages = 0;
    std::uint64_t bytes = 0;
    std::uint64_t most_bytes = 0;
    std::uint64_t neighbours = 0;
    std::uint64_t most_neighbours = 0;
    /// Edges in the interfaces of all ranks: an edge that two ranks share counts twice, because
    /// either rank may have to notify the other.
    std::uint64_t interface_edges = 0;
};

std::uint64_t interface_edges_of(const distributed::DistributedMesh& mesh) {
    std::uint64_t edges = 0;
    for (const auto& interface : mesh.interfaces) edges += interface.edges.size();
    return edges;
}

Figures measure(const distributed::Communicator& world, std::size_t n, double share, Scheme scheme,
                Synchronisation synchronisation) {
    const Mesh lattice = world.is_first() ? test::perturbed_kuhn(n, 0.2, 1) : Mesh{};
    std::vector<int> cell_to_rank;
    if (world.is_first()) {
        cell_to_rank = distributed::partition_cells(lattice, world.size(),
                                                    {.method = distributed::PartitionMethod::lepp});
    }
    auto mesh = distributed::distribute(world, lattice, cell_to_rank);
    Figures figures{.cells = world.sum(mesh.cells.size()),
                    .neighbours = world.sum(mesh.interfaces.size()),
                    .most_neighbours = world.max(mesh.interfaces.size()),
                    .interface_edges = world.sum(interface_edges_of(mesh))};
    const Selection selection{.random = RandomShare{share, 1}};
    const auto counts = distributed::refine(
        mesh, selection, {.scheme = scheme, .levels = 1, .synchronisation = synchronisation});
    figures.fine_cells = world.sum(mesh.cells.size());
    figures.rounds = counts.rounds;
    figures.messages = world.sum(counts.messages);
    figures.most_messages = world.max(counts.messages);
    figures.bytes = world.sum(counts.bytes);
    figures.most_bytes = world.max(counts.bytes);
    return figures;
}

double ratio(std::uint64_t a, std::uint64_t b) {
    return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b);
}

std::string_view name_of(Scheme scheme) { return scheme == Scheme::eight ? "8t" : "2t"; }

void print_comparison(std::uint64_t ranks, Scheme scheme, double share, std::string_view sync,
                      const Figures& f) {
    fmt::print("{} {:4.0f} %  {:<9} {:>6} {:>9.1f} {:>4} {:>8.1f} {:>4} {:>9} {:>7} {:>8.3f}\n",
               name_of(scheme), 100 * share, sync, f.rounds, ratio(f.neighbours, ranks),
               f.most_neighbours, ratio(f.messages, ranks * f.rounds),
               f.rounds == 0 ? 0 : f.most_messages / f.rounds, f.bytes, f.most_bytes,
               ratio(f.bytes, f.interface_edges));
}

void compare_synchronisations(const distributed::Communicator& world, std::size_t n) {
    const auto ranks = static_cast<std::uint64_t>(world.size());
    if (world.is_first()) {
        fmt::print("{} ranks, {} cells, one level\n", ranks, 6 * n * n * n);
        fmt::print("{:27}{:>15}{:>14}{:>18}{:>9}\n", "", "neighbours", "messages", "bytes",
                   "bytes an");
        fmt::print("{:<11}{:<9} {:>6} {:>9} {:>4} {:>8} {:>4} {:>9} {:>7} {:>8}\n", "marked",
                   "sync", "rounds", "mean", "most", "mean", "most", "all", "most", "edge");
    }
    for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
        for (const double share : {0.01, 0.1}) {
            for (const auto& [sync, name] : {std::pair{Synchronisation::neighbour, "neighbour"},
                                             std::pair{Synchronisation::gateway, "gateway"}}) {
                const Figures figures = measure(world, n, share, scheme, sync);
                if (world.is_first()) print_comparison(ranks, scheme, share, name, figures);
            }
        }
    }
}

void grow_the_mesh(const distributed::Communicator& world, std::size_t n) {
    constexpr std::array<double, 3> shares{0.001, 0.01, 0.1};
    if (world.is_first()) {
        fmt::print("\nrounds as the mesh grows, by what is marked\n   cells");
        for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
            for (const double share : shares)
                fmt::print("  {} {:4.1f} %", name_of(scheme), 100 * share);
        }
        fmt::print("\n");
    }
    for (const std::size_t size : {n / 2, n, 2 * n}) {
        std::string line = fmt::format("{:>8}", 6 * size * size * size);
        for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
            for (const double share : shares) {
                const Figures figures =
                    measure(world, size, share, scheme, Synchronisation::neighbour);
                line += fmt::format("{:>11}", figures.rounds);
            }
        }
        if (world.is_first()) fmt::print("{}\n", line);
    }
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const bool is_given = argc > 1 && argv[1][0] != '-';
    const std::size_t n = is_given ? std::strtoul(argv[1], nullptr, 10) : 20;
    octetra::compare_synchronisations(session.world(), n);
    octetra::grow_the_mesh(session.world(), n);
}
