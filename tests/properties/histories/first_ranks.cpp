#include "properties/histories/first_ranks.hpp"

#include <octetra/distributed/mpi.hpp>

#include "distributed/world.hpp"

namespace octetra::properties {

using distributed::Communicator;

Communicator first_ranks(int count) {
    const Communicator& world = test::world();
    if (count >= world.size()) return world;
    if (count == 1) return {};
    const int colour = world.rank() < count ? 0 : MPI_UNDEFINED;
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, colour, world.rank(), &part);
    if (part == MPI_COMM_NULL) return {};
    Communicator group = distributed::communicator_of(part);
    MPI_Comm_free(&part);
    return group;
}

}  // namespace octetra::properties
