#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <octetra/distributed/communicator.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Collective. Throws on all processes if one has failed, as failure.agree() does. Throws
/// InputError, with the same message on all, unless all processes pass the same `value` of the
/// argument `name`. Takes one reduction if nothing is wrong.
void agree_on_same(const Communicator& processes, LocalFailure& failure, std::string_view name,
                   const std::function<std::string()>& value);

}  // namespace octetra::distributed
