/// Communication of synchronisation by partition and scheme: `mpirun -n P bench_synchronise [N |
/// MESH]` refines a perturbed lattice of N^3 cubes, or a mesh, twice at random places. Prints
/// counts, not times, which are the same on any machine.

#include <string>

#include <fmt/format.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/partition.hpp>
#include <octetra/distributed/refine.hpp>

#include "support/meshes.hpp"

namespace octetra {
namespace {

std::string name_of(Scheme scheme) {
    if (scheme == Scheme::eight) return "8t";
    return scheme == Scheme::four ? "4t" : "2t";
}

void count(const distributed::Communicator& world, const Mesh& input, double share, Scheme scheme,
           const std::string& method) {
    std::vector<int> cell_to_rank;
    if (world.is_first()) {
        cell_to_rank =
            distributed::partition_cells(input, world.size(), distributed::parse_partition(method));
    }
    auto mesh = distributed::distribute(world, input, cell_to_rank);
    const Selection selection{.random = RandomShare{share, 1}};
    const auto counts = distributed::refine(mesh, selection, {.scheme = scheme, .levels = 2});
    const auto messages = world.sum(counts.messages);
    const auto edges = world.sum(counts.edges);
    const auto cells = world.sum(mesh.cells.size());
    if (!world.is_first()) return;
    fmt::print("{}  {:4.0f} % marked  {:<5} {:>9} cells, {} rounds, {:>4} messages, {:>6} edges\n",
               name_of(scheme), 100 * share, method, cells, counts.rounds, messages, edges);
}

Mesh mesh_of_argument(const std::string& argument) {
    const bool is_number = argument.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? test::perturbed_kuhn(std::stoul(argument), 0.2, 1) : read_mesh(argument);
}

void count_all(const distributed::Communicator& world, const std::string& argument) {
    const Mesh mesh = world.is_first() ? mesh_of_argument(argument) : Mesh{};
    if (world.is_first()) fmt::print("on {} ranks\n", world.size());
    for (const Scheme scheme : {Scheme::eight, Scheme::four, Scheme::two}) {
        for (const double share : {0.01, 0.1}) {
            for (const std::string method : {"lepp", "dual", "block"}) {
                count(world, mesh, share, scheme, method);
            }
        }
    }
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    const bool is_given = argc > 1 && argv[1][0] != '-';
    octetra::count_all(session.world(), is_given ? argv[1] : "20");
}
