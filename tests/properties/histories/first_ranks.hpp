#pragma once

#include <octetra/distributed/communicator.hpp>

namespace octetra::properties {

/// Collective over all ranks. The first `count` of them; on the others a group of one, not to be
/// used.
[[nodiscard]] distributed::Communicator first_ranks(int count);

}  // namespace octetra::properties
