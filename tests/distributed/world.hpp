#pragma once

#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::test {

/// The communicator of the processes that mpirun started for this test.
const distributed::Communicator& world();

/// Collective. Returns the entries of all processes, in the order of their ranks, on each process.
template <class T>
std::vector<std::vector<T>> of_all(const std::vector<T>& own) {
    return world().all_to_all(
        std::vector<std::vector<T>>(static_cast<std::size_t>(world().size()), own));
}

}  // namespace octetra::test
