#pragma once

#include <octetra/distributed/communicator.hpp>

/// A lock that the processes of a communicator on one machine share. Taking it needs neither
/// messages nor memory, so a process that is out of memory can take it while others wait elsewhere.
/// The system releases it when its holder exits for any reason.
namespace octetra::distributed {

/// Collective. Returns the file descriptor of the lock, -1 if the system provides none. No file is
/// left behind.
[[nodiscard]] int open_common_lock(const Communicator& processes);

/// Returns true to the first caller, and to every caller if there is no lock. The other callers
/// block until that process has ended, and receive false.
[[nodiscard]] bool try_claim(int lock);

}  // namespace octetra::distributed
