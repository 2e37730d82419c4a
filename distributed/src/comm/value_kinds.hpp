#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/value_kind.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Collective. Throws on all processes if one has failed. Throws InputError, with the same message
/// on all, unless all pass values of the same kind. Takes one reduction if nothing is wrong.
void agree_on_kind(const Communicator& processes, LocalFailure& failure,
                   const detail::ValueKind& kind);

/// Collective. Checks the sizes of messages received from `senders`. Throws on all processes if one
/// has failed (a process without memory has sent nothing), else InputError if a message does not
/// have the expected size.
void agree_on_sizes(const Communicator& processes, LocalFailure& failure,
                    std::span<const int> senders,
                    const std::vector<std::vector<std::byte>>& messages,
                    const std::function<std::size_t(std::size_t n)>& expected);

/// Throws InputError unless process `sender` has sent `expected` bytes.
void check_message_size(const Communicator& processes, int sender, std::size_t size,
                        std::size_t expected);

}  // namespace octetra::distributed
