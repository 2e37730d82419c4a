/// What ranks tell each other, by partition and scheme: `mpirun -n P bench_synchronise [N]` refines
/// a shaken lattice of N^3 cubes twice at random places. Counts, not times: any machine gives the
/// same.

#include <cstdlib>
#include <string>

#include <fmt/format.h>

#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

void count(const distributed::Communicator& world, const Mesh& lattice, double share, Scheme scheme,
           const std::string& method) {
    std::vector<int> cell_to_rank;
    if (world.is_first()) {
        cell_to_rank = distributed::partition_cells(lattice, world.size(),
                                                    distributed::parse_partition(method));
    }
    auto mesh = distributed::distribute(world, lattice, cell_to_rank);
    const Selection selection{.random = RandomShare{share, 1}};
    const auto counts = distributed::refine(mesh, selection, {.scheme = scheme, .levels = 2});
    const auto messages = world.sum(counts.messages);
    const auto edges = world.sum(counts.edges);
    const auto cells = world.sum(mesh.cells.size());
    if (!world.is_first()) return;
    fmt::print("{}  {:4.0f} % chosen  {:<5} {:>9} cells, {} rounds, {:>4} messages, {:>6} edges\n",
               scheme == Scheme::eight ? "8t" : "2t", 100 * share, method, cells, counts.rounds,
               messages, edges);
}

void count_all(const distributed::Communicator& world, std::size_t n) {
    const Mesh lattice = world.is_first() ? test::shaken_kuhn(n, 0.2, 1) : Mesh{};
    if (world.is_first()) fmt::print("on {} ranks\n", world.size());
    for (const Scheme scheme : {Scheme::eight, Scheme::two}) {
        for (const double share : {0.01, 0.1}) {
            for (const std::string method : {"lepp", "dual", "block"}) {
                count(world, lattice, share, scheme, method);
            }
        }
    }
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const bool is_given = argc > 1 && argv[1][0] != '-';
    octetra::count_all(session.world(), is_given ? std::strtoul(argv[1], nullptr, 10) : 20);
}
