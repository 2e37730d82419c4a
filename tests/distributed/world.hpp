#pragma once

#include <octetra/distributed/communicator.hpp>

namespace octetra::test {

/// The processes that mpirun started for this test.
const distributed::Communicator& world();

}  // namespace octetra::test
