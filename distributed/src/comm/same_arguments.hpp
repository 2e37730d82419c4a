#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Collective. Throws on all processes what has failed on one, as failure.agree() does, and
/// InputError, in the same words, unless all have the same `value` of the argument called `name`.
/// Takes one reduction where nothing is wrong.
void agree_on_same(const Communicator& processes, LocalFailure& failure, std::string_view name,
                   const std::function<std::string()>& value);

}  // namespace octetra::distributed
