#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/value_kind.hpp>

#include "comm/local_failure.hpp"

namespace octetra::distributed {

/// Collective. Throws on all processes what has failed on one, and InputError, in the same words,
/// unless all pass values of the same kind. Takes one reduction where nothing is wrong.
void agree_on_kind(const Communicator& processes, LocalFailure& failure,
                   const detail::ValueKind& kind);

/// Collective. After messages were received from `senders`: throws on all processes what has failed
/// on one, where a process without memory has sent nothing; else InputError where a message has not
/// the size that is expected.
void agree_on_sizes(const Communicator& processes, LocalFailure& failure,
                    std::span<const int> senders,
                    const std::vector<std::vector<std::byte>>& messages,
                    const std::function<std::size_t(std::size_t n)>& expected);

/// Throws InputError unless process `sender` has sent as many bytes as this one expects.
void check_message_size(const Communicator& processes, int sender, std::size_t size,
                        std::size_t expected);

}  // namespace octetra::distributed
