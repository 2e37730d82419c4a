#pragma once

#include <octetra/distributed/communicator.hpp>

/// A lock that the processes of a group on one machine have in common. It takes neither messages
/// nor memory to be taken, so also a process that is out of memory can, while others wait for it
/// elsewhere. When its holder ends, in whatever way, nobody waits for it any more.
namespace octetra::distributed {

/// Collective. The descriptor of the lock, which leaves no file behind; -1 if the system gives
/// none.
[[nodiscard]] int open_common_lock(const Communicator& processes);

/// True for the first process to ask, and where there is no lock. All others hear false, when that
/// one has ended.
[[nodiscard]] bool is_first_to_take(int lock);

}  // namespace octetra::distributed
