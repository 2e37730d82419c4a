#pragma once

#include <octetra/distributed/communicator.hpp>

namespace octetra::properties {

/// Collective over all ranks. Returns a communicator of the first `count` ranks; the other ranks
/// get one of a single process, which must not be used.
[[nodiscard]] distributed::Communicator first_ranks(int count);

}  // namespace octetra::properties
