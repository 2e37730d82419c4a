#pragma once

#include <vector>

#include <octetra/distributed/communicator.hpp>

namespace octetra::test {

/// The processes that mpirun started for this test.
const distributed::Communicator& world();

/// Collective. On each process, what all processes have, in the order of their ranks.
template <class T>
std::vector<std::vector<T>> of_all(const std::vector<T>& own) {
    return world().all_to_all(
        std::vector<std::vector<T>>(static_cast<std::size_t>(world().size()), own));
}

}  // namespace octetra::test
