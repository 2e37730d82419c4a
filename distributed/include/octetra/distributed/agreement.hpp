#pragma once

#include <functional>

#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// Collective. Runs `work` on the first process, while the others wait. What it throws there is
/// thrown on all: an InputError as such, all else as SystemError.
void on_first(const Communicator& processes, const std::function<void()>& work);

}  // namespace octetra::distributed
